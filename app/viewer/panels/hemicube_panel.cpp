#include "viewer/panels/hemicube_panel.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "render/display_modes.h"
#include "viewer/panels/lecture_panel.h"
#include "viewer/panels/widgets.h"
#include "viewer/teaching.h"
#include "viewer/window_words.h"

namespace unshot {
namespace {

constexpr float kSide = 17;            // of the cross, in letters' heights
constexpr float kLines = 10.5f;        // of text beside it, the same
constexpr float kLeast = 5;            // of the cross, or there is no room for it
constexpr float kMostOfScene = 0.45f;  // of the scene's height that it takes

ImTextureID textureId(const gl::Texture& texture) {
  return reinterpret_cast<ImTextureID>(std::uintptr_t{texture.id()});
}

void choosePicture(Viewer& viewer, float width) {
  const HemicubeColours shown = viewer.teaching().choices.picture;
  const auto rows = hemicubePictures();
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.colours == shown; });
  ImGui::SetNextItemWidth(width);
  const std::string key =
      choose("##picture", rows, std::string(row->info.key), std::string(row->info.title), nullptr);
  if (!key.empty()) viewer.perform("hemicube-picture", key);
}

/// What the pixel at this place of the cross sees, in units of its side, and marks it; empty where there is
/// no pixel.
std::string pixelText(Viewer& viewer, const glm::dvec2& at) {
  Teaching& teaching = viewer.teaching();
  const HemicubeLook& look = *teaching.look();
  const double size = crossSize(look.layout);
  const auto place = [&](double where) {
    return static_cast<std::uint32_t>(std::clamp(where * size, 0.0, size - 1));
  };
  const std::optional<std::size_t> pixel = crossPixel(look.layout, place(at.x), place(at.y));
  if (!pixel) return {};
  const std::uint32_t patch = look.patchAt(*pixel);
  std::string text =
      patch == kNone ? "Nothing: what leaves here escapes" : "Patch " + patchText(*look.mesh, patch);
  text += "\nThis pixel: \u0394G = " + channelText((*look.delta)[*pixel]);
  const double share = teaching.shares()[patch == kNone ? look.mesh->patch_count : patch];
  text += "\nAll of its pixels: G_ij = " + channelText(share);
  const PatchInsight* known = teaching.patch();
  if (known && known->patch == look.patch && !known->sent.empty()) {
    const double solved = patch == kNone ? known->escape : static_cast<double>(known->sent[patch]);
    text += "\nThe solver's G_ij: " + channelText(solved);
  }
  if (patch != kNone) teaching.markPatch(patch, false, true);
  return text;
}

void cross(Viewer& viewer, float side) {
  Teaching& teaching = viewer.teaching();
  const gl::Texture* picture = teaching.cross();
  if (!picture) {
    ImGui::Dummy({side, side});
    return;
  }
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::Image(textureId(*picture), {side, side});
  if (!teaching.look()) return;
  const double width = static_cast<double>(side);
  if (ImGui::IsItemHovered()) {
    const glm::dvec2 mouse(ImGui::GetMousePos().x - at.x, ImGui::GetMousePos().y - at.y);
    tooltip(pixelText(viewer, mouse / width));
  } else if (const auto& chosen = teaching.choices.pixel) {
    const ImVec2 middle(at.x + static_cast<float>(chosen->x * width),
                        at.y + static_cast<float>(chosen->y * width));
    const float radius = 0.25f * ImGui::GetFontSize();
    ImGui::GetWindowDrawList()->AddRect({middle.x - radius, middle.y - radius},
                                        {middle.x + radius, middle.y + radius}, IM_COL32(255, 255, 255, 255));
    if (const std::string text = pixelText(viewer, *chosen); !text.empty()) wrapped(text, side);
  }
}

void sums(const Teaching& teaching, float side) {
  const HemicubeLook& look = *teaching.look();
  double sum = 0;
  for (const double delta : *look.delta) sum += delta;
  const double escape = teaching.shares().back();
  const std::string arrives = "\u2211\u0394G = " + figureText(sum - escape),
                    escapes = "escapes " + figureText(escape);
  std::string text = escape > 0 ? arrives + ", " + escapes : arrives;
  // ImGui's own lines end after any point or comma, also within a number.
  if (ImGui::CalcTextSize(text.c_str()).x > side)
    text = brokenText(arrives, side) + "\n" + brokenText(escapes, side);
  ImGui::TextUnformatted(text.c_str());
  tooltip(
      "Delta form factors of all pixels that see something, and of those that see nothing: together 1. In a "
      "closed scene nothing escapes");
}

}  // namespace

std::string patchText(const Mesh& mesh, std::uint32_t patch) {
  const Surface& surface = mesh.surfaces[mesh.sides[mesh.patch_side[patch]].surface];
  return "no. " + std::to_string(patch) + ", " + mesh.materials[surface.material].name;
}

void hemicubeContent(Viewer& viewer, float side) {
  Teaching& teaching = viewer.teaching();
  const std::uint32_t patch = teaching.hemicubePatch();
  const SessionState& state = viewer.state();
  if (!state.snapshot || patch == kNone || patch >= state.snapshot->mesh->patch_count) {
    dimmed("No patch is picked and none has light to shoot. Click a surface.", side);
    return;
  }
  wrapped("Patch " + patchText(*state.snapshot->mesh, patch), side);
  tooltip(teaching.hemicubeIsPicked() ? "The picked patch. Esc: the patch that shoots"
                                      : "The patch with the most unshot power, or the one of the last single "
                                        "step. Click a surface for another");
  if (const auto problem = teaching.problem()) {
    wrapped(windowWords(problem->what()), side);
    return;
  }
  cross(viewer, side);
  if (teaching.look()) sums(teaching, side);
  teaching.markPatch(patch, true, false);
}

void buildHemicube(Viewer& viewer, LowerEdge& edge) {
  if (!viewer.teaching().choices.hemicube || lectureShowsHemicube(viewer)) return;
  const float em = ImGui::GetFontSize(), gap = 0.7f * em;
  const float widest = std::min((kSide + 3) * em, edge.sceneWidth());
  const float bottom = edge.above(0, widest);
  const float room = std::min(edge.sceneWidth() - 4 * em, bottom - edge.top() - gap - kLines * em);
  const float side = std::floor(std::min({kSide * em, room, kMostOfScene * bottom}));
  const bool fits = side >= kLeast * em;
  if (!fits && bottom - 2 * gap - em - 2 * ImGui::GetStyle().WindowPadding.y < edge.top()) return;
  ImGui::SetNextWindowPos({gap, bottom - gap}, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowBgAlpha(0.94f);
  ImGui::Begin("hemicube", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
  if (!fits) {
    ImGui::TextDisabled("no room for the hemicube (U)");
    edge.take(0, ImGui::GetWindowWidth() + 2 * gap, bottom - gap - ImGui::GetWindowHeight());
    ImGui::End();
    return;
  }
  ImGui::BeginGroup();
  ImGui::TextDisabled("Hemicube");
  tooltip(
      "What a patch sees through the five faces of half a cube, unfolded: the top in the middle, horizons "
      "outside. Traced with rays, " +
      std::to_string(HemicubeEye::kLayout.resolution) +
      " pixels along an edge, whatever the solve takes: its own hemicubes may be finer or coarser, and are "
      "drawn by OpenGL where that is faster");
  const float button = ImGui::CalcTextSize("\u00d7").x + 2 * ImGui::GetStyle().FramePadding.x;
  ImGui::SameLine(ImGui::GetCursorStartPos().x + side - button);
  if (ImGui::SmallButton("\u00d7")) viewer.perform("hemicube-view", "off");
  tooltip("U: closes it");
  ImGui::EndGroup();
  ImGui::Dummy({side, 0});
  choosePicture(viewer, side);
  hemicubeContent(viewer, side);
  edge.take(0, ImGui::GetWindowWidth() + 2 * gap, bottom - gap - ImGui::GetWindowHeight());
  ImGui::End();
}

void teachingSection(Viewer& viewer) {
  if (!section("Lecture")) return;
  const TeachingChoices& choices = viewer.teaching().choices;
  bool on = choices.lecture;
  if (ImGui::Checkbox("Lecture", &on)) viewer.perform("lecture", on ? "on" : "off");
  tooltip(
      "T: beside the scene, the matrix M, the equation with live numbers, single shots, and what radiosity "
      "shows");
  ImGui::SameLine(9.0f * ImGui::GetFontSize());
  on = choices.hemicube;
  if (ImGui::Checkbox("Hemicube", &on)) viewer.perform("hemicube-view", on ? "on" : "off");
  tooltip(
      "U: what the picked patch, or else the one that shoots, sees through the five faces of half a cube");
}

}  // namespace unshot

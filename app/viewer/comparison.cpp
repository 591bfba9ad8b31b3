#include "viewer/comparison.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

#include "base/srgb.h"
#include "base/text.h"
#include "export/probes.h"
#include "viewer/panels/widgets.h"

namespace unshot {
namespace {

// Vertices that lie on no surface of a solution that was loaded: more than this share of them, and it is of
// another scene.
constexpr double kMostOutside = 0.02;
// Of the time to load a solution on another mesh.
constexpr double kReadingShare = 0.2;
// How far from a vertex towards its triangles' middles a solution on another mesh is asked.
constexpr double kBeside = 0.02;
// In letters' heights: a scale that has room for all its figures.
constexpr float kWideScale = 22;
constexpr float kColoursWidth = 8;  // of the legend of sides and normals, in letters' heights

std::string bouncesText(std::uint32_t bounces, bool alone) {
  return alone ? "bounce " + countText(bounces) + " alone" : "up to " + countedText(bounces, "bounce");
}

const Snapshot& snapshotOf(const SessionState& state) {
  if (!state.snapshot) throw Error(ErrorKind::kUsage, "there is no light yet", {}, "open a scene first");
  return *state.snapshot;
}

std::string nameOf(const Snapshot& snapshot, const LightChoice& choice) {
  if (!choice.indirect) return "direct light alone";
  const std::string at = countedText(snapshot.measures.shots, "shot");
  const std::uint32_t bounces = shownBounces(snapshot, choice);
  return bounces > 0 ? bouncesText(bounces, choice.alone) : "the state at " + at;
}

ImU32 colourOf(double relative) {
  const glm::dvec3 linear = differenceColour(relative);
  return IM_COL32(srgb8FromLinear(static_cast<float>(linear.x)),
                  srgb8FromLinear(static_cast<float>(linear.y)),
                  srgb8FromLinear(static_cast<float>(linear.z)), 255);
}

/// The difference at a place of the scale, from -1 to 1.
double differenceAt(double place) {
  const double size = std::pow(kLeastDifference, 1 - std::abs(place));
  return place < 0 ? -size : size;
}

void drawScale(ImVec2 at, float width, float em) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto steps = static_cast<int>(width);
  for (int k = 0; k < steps; ++k) {
    const double place = 2 * (k + 0.5) / steps - 1;
    const float x = at.x + static_cast<float>(k);
    list.AddRectFilled({x, at.y}, {x + 1, at.y + em}, colourOf(differenceAt(place)));
  }
  const std::array<double, 7> ticks = {-1, -2.0 / 3, -1.0 / 3, 0, 1.0 / 3, 2.0 / 3, 1};
  for (std::size_t k = 0; k < ticks.size(); ++k) {
    const double place = ticks[k];
    const float x = std::round(at.x + static_cast<float>((place + 1) / 2) * (width - 1));
    list.AddRectFilled({x, at.y + em}, {x + 1, at.y + 1.3f * em}, ImGui::GetColorU32(ImGuiCol_Text, 0.6f));
    if (k % 3 != 0 && width < kWideScale * em) continue;  // the ends and the middle have room
    const std::string text =
        place == 0 ? "0" : (place < 0 ? "\u2212" : "+") + percentText(std::abs(differenceAt(place)));
    const float half = ImGui::CalcTextSize(text.c_str()).x / 2;
    const float left = std::clamp(x - half, at.x - em, at.x + width + em - 2 * half);
    list.AddText({left, at.y + 1.35f * em}, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
  }
}

}  // namespace

float differenceScaleWidth(float room) {
  const float em = ImGui::GetFontSize();
  return std::clamp(room - 6 * em, 6 * em, 26 * em) + 2 * em;
}

void differenceScale(const std::string& title, const char* unit, float room) {
  const float em = ImGui::GetFontSize(), width = differenceScaleWidth(room) - 2 * em;
  wrapped(title, width + 2 * em);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  drawScale({at.x + em, at.y}, width, em);
  ImGui::Dummy({width + 2 * em, 2.5f * em});
  const float left = ImGui::GetCursorPosX();
  const auto word = [&](const char* text, float place) {
    ImGui::SetCursorPosX(left + place * (width + 2 * em - ImGui::CalcTextSize(text).x));
    ImGui::TextDisabled("%s", text);
  };
  word("darker", 0);
  ImGui::SameLine();
  if (width >= kWideScale * em) {
    word(unit, 0.5f);
    ImGui::SameLine();
  }
  word("brighter", 1);
  if (width < kWideScale * em) word(unit, 0.5f);
}

namespace {

/// What colours of surfaces stand for: a dot and a word each.
void colourLegend(Quantity quantity) {
  struct Row {
    ImVec4 colour;
    const char* text;
  };
  const std::array<Row, 2> sides = {
      {{{0.27f, 0.53f, 0.86f, 1}, "front"}, {{0.91f, 0.54f, 0.19f, 1}, "back"}}};
  const std::array<Row, 3> axes = {
      {{{0.95f, 0.45f, 0.4f, 1}, "+x"}, {{0.45f, 0.9f, 0.4f, 1}, "+y"}, {{0.5f, 0.55f, 1, 1}, "+z"}}};
  const std::span<const Row> rows = quantity == Quantity::kSides ? std::span<const Row>(sides) : axes;
  for (const Row& row : rows) {
    if (&row != rows.data()) ImGui::SameLine(0, ImGui::GetFontSize());
    dot(row.colour);
    ImGui::TextUnformatted(row.text);
  }
}

/// The part of the light that is shown, in words; empty for all of it.
std::string lightText(const SessionState& state, const LightChoice& choice) {
  if (choice.all()) return {};
  if (!choice.indirect) return "direct light only";
  const std::uint32_t bounces = shownBounces(*state.snapshot, choice);
  if (bounces == *choice.bounces) return bouncesText(bounces, choice.alone);
  if (bounces > 0) {
    const std::string rest = choice.alone ? "; bounce " + countText(*choice.bounces) + " is" : "; more are";
    return bouncesText(bounces, choice.alone) + rest + " not known" + (state.bounces_under_way ? " yet" : "");
  }
  const std::string wait = bounceWaitText(state);
  return bouncesText(*choice.bounces, choice.alone) +
         " not known yet, all light is shown: " + (wait.empty() ? "worked out while the solve rests" : wait);
}

/// Whether the solution's vertices are those of the mesh.
bool isOn(const Mesh& mesh, const PlySolution& solution) {
  if (solution.positions.size() != mesh.vertices.size()) return false;
  const double close = 1e-5 * glm::length(mesh.bounds_max - mesh.bounds_min);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const glm::dvec3 p = glm::dvec3(mesh.vertices[v].position) + mesh.frame_origin;
    if (glm::distance(p, solution.positions[v]) > close) return false;
  }
  return true;
}

/// A point beside each vertex, on its surface: at the vertex itself a neighbour may lie in the same plane.
std::vector<Probe> besideVertices(const Mesh& mesh) {
  std::vector<glm::dvec3> sum(mesh.vertices.size(), glm::dvec3(0.0));
  std::vector<double> count(mesh.vertices.size(), 0.0);
  for (std::size_t k = 0; k < mesh.triangle_vertices.size(); ++k) {
    const std::uint32_t* corner = &mesh.triangle_vertices[k - k % 3];
    for (int c = 0; c < 3; ++c)
      sum[mesh.triangle_vertices[k]] += glm::dvec3(mesh.vertices[corner[c]].position) / 3.0;
    count[mesh.triangle_vertices[k]] += 1;
  }
  std::vector<Probe> probes;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const glm::dvec3 at(mesh.vertices[v].position);
    const glm::dvec3 beside = count[v] > 0 ? glm::mix(at, sum[v] / count[v], kBeside) : at;
    probes.push_back({beside + mesh.frame_origin, glm::dvec3(mesh.vertices[v].normal)});
  }
  return probes;
}

/// The solution's radiosity at the vertices of another mesh of its scene.
std::vector<glm::dvec3> broughtTo(const Snapshot& snapshot, const PlySolution& solution,
                                  const std::string& file, const CancelToken& cancel) {
  const auto answers = answerProbes(solution, besideVertices(*snapshot.mesh), cancel);
  std::vector<glm::dvec3> out;
  std::size_t outside = 0;
  for (std::size_t v = 0; v < answers.size(); ++v) {
    outside += !answers[v];
    // Where it says nothing there is no difference.
    out.push_back(answers[v].value_or(radiosity(snapshot, v, false)));
  }
  if (static_cast<double>(outside) <= kMostOutside * static_cast<double>(answers.size())) return out;
  throw Error(ErrorKind::kInput,
              "the solution is of another scene: it has nothing at " + countText(outside) + " of " +
                  countText(answers.size()) + " vertices",
              file, "a file that unshot solve --ply wrote of this scene");
}

}  // namespace

std::uint32_t shownBounces(const Snapshot& snapshot, const LightChoice& choice) {
  if (!choice.indirect || !choice.bounces || !snapshot.bounce_light) return 0;
  return std::min(*choice.bounces, static_cast<std::uint32_t>(snapshot.bounce_light->received.size()));
}

std::string bounceWaitText(const SessionState& state) {
  if (!state.snapshot || !state.facts) return {};
  const BounceWait& wait = state.snapshot->bounce_wait;
  if (wait.columns == 0) return {};
  if (wait.no_room) return "form factors do not fit into their memory, which the action keep makes larger";
  return countText(wait.columns) + " of " + countText(state.facts->patches) +
         " columns of form factors are missing";
}

std::shared_ptr<const ReferenceLight> rememberedLight(const SessionState& state, const LightChoice& choice) {
  const Snapshot& snapshot = snapshotOf(state);
  return std::make_shared<const ReferenceLight>(referenceLight(snapshot, choice, nameOf(snapshot, choice)));
}

std::shared_ptr<const ReferenceLight> loadedLight(const Snapshot& snapshot, const std::filesystem::path& ply,
                                                  const CancelToken& cancel) {
  PlySolution solution = readPly(ply, cancel.part(0, kReadingShare));
  if (!isOn(*snapshot.mesh, solution))
    solution.radiosity = broughtTo(snapshot, solution, ply.string(), cancel.part(kReadingShare, 1));
  cancel.check();
  return std::make_shared<const ReferenceLight>(
      referenceLight(snapshot.mesh, solution.radiosity, ply.filename().string()));
}

std::string differenceTitle(const SessionState& state, const ViewOptions& view) {
  const std::string light = lightText(state, view.light);
  const bool fits =
      view.reference && state.snapshot && view.reference->mesh->cut == state.snapshot->mesh->cut;
  return (light.empty() ? "all light" : light) + " \u2212 " +
         (fits ? view.reference->name : "direct light alone") + ", of its mean reflected light";
}

void buildLegend(const SessionState& state, const ViewOptions& view, LowerEdge& edge) {
  if (!state.snapshot) return;
  const Quantity quantity = displayMode(view.display).quantity;
  const bool colours = quantity == Quantity::kSides || quantity == Quantity::kNormals;
  const float em = ImGui::GetFontSize(), gap = 0.7f * em;
  const float borders = 2 * ImGui::GetStyle().WindowPadding.x + 2 * gap;
  const std::string light =
      brokenText(lightText(state, view.light), std::max(edge.sceneWidth() - borders, 8 * em));
  if (light.empty() && !colours) return;
  // Beside the legend of false colours, where there is room.
  const float width = borders + (colours ? kColoursWidth * em : ImGui::CalcTextSize(light.c_str()).x);
  const float bottom = edge.above(0, width);
  const float height = ImGui::CalcTextSize(light.c_str()).y + 2 * ImGui::GetStyle().WindowPadding.y;
  if (bottom - gap - height < edge.top()) return;
  ImGui::SetNextWindowPos({gap, bottom - gap}, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin("legend", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing |
                   ImGuiWindowFlags_NoInputs);
  if (colours) {
    colourLegend(quantity);
  } else {
    ImGui::TextUnformatted(light.c_str());
  }
  edge.take(0, width, bottom - gap - ImGui::GetWindowHeight());
  ImGui::End();
}

}  // namespace unshot

// The lecture's other pages: the equation with a patch's numbers, single shots, and what radiosity shows.
#include <array>
#include <cmath>
#include <numbers>

#include "base/text.h"
#include "viewer/panels/bounce_panel.h"
#include "viewer/panels/hemicube_panel.h"
#include "viewer/panels/lecture_panel.h"
#include "viewer/panels/widgets.h"
#include "viewer/teaching.h"

namespace unshot {
namespace {

constexpr std::string_view kLightUnit = "W/m\u00b2";
// Widths that have room for a column of names, and of units, in letters' heights.
constexpr float kWideEffects = 24, kWideChannels = 25;

/// A name, three figures and, where there is room for it, a unit.
bool beginChannelsAndUnits(const char* id) {
  const bool wide = ImGui::GetContentRegionAvail().x > kWideChannels * ImGui::GetFontSize();
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding,
                      {0.2f * ImGui::GetFontSize(), ImGui::GetStyle().CellPadding.y});
  const bool begun = ImGui::BeginTable(id, wide ? 5 : 4, ImGuiTableFlags_NoPadOuterX);
  ImGui::PopStyleVar();
  if (!begun) return false;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
  for (int k = 0; k < 3; ++k) ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, channelWidth());
  if (wide)
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, ImGui::CalcTextSize("W/(m\u00b2 sr)").x);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  for (const char* name : {"red", "green", "blue"}) {
    ImGui::TableNextColumn();
    rightAligned(name, true);
  }
  return true;
}

void row(const char* name, const glm::dvec3& value, std::string_view unit, std::string_view what) {
  const std::string tip = std::string(what) + (unit.empty() ? "" : " [" + std::string(unit) + "]");
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(name);
  tooltip(tip);
  for (int k = 0; k < 3; ++k) {
    ImGui::TableNextColumn();
    rightAligned(channelText(value[k]));
    tooltip(tip);
  }
  if (ImGui::TableGetColumnCount() < 5) return;
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", std::string(unit).c_str());
}

void equationRows(const PatchInsight& p) {
  if (!beginChannelsAndUnits("equation")) return;
  row("B_i", p.radiosity, kLightUnit,
      "Radiosity of the patch: all light that leaves it, emitted and reflected. Unknown of the equation");
  row("= E_i", p.emission, kLightUnit, "Light that it emits by itself. Known");
  row("+ R_i", p.reflectance, "",
      "Part of the light received that is reflected, 0 to 1: the lecture's letter for the reflectance "
      "\u03c1. Known; this is where the BRDF is");
  row("\u00d7 \u2211 G_ij B_j", p.gathered, kLightUnit,
      "Light received from all patches j, the form factor G_ij being the part of i's view that j fills: "
      "the sum over those at hand with the radiosities as they are now");
  row("right side", p.emission + p.reflectance * p.gathered, kLightUnit,
      "E_i + R_i \u2211 G_ij B_j: equal to B_i once all is shot");
  row("difference", p.emission + p.reflectance * p.gathered - p.radiosity, kLightUnit,
      "What is missing of B_i: light that others have not shot yet, or whose form factors are not at hand");
  row("of it shot: H_i", p.received, kLightUnit,
      "Irradiance: the part of the sum that others have shot already");
  row("U_i", p.unshot, kLightUnit, "What the patch itself has not shot yet");
  row("L = B / \u03c0", p.radiosity / std::numbers::pi, "W/(m\u00b2 sr)",
      "Radiance: the same from wherever it is looked at, which is why the result does not depend on the "
      "view");
  row("f = R / \u03c0", p.reflectance / std::numbers::pi, "1/sr",
      "BRDF of a diffuse surface: the same in all directions");
  row("A_i B_i", p.area * p.radiosity, "W", "A_i B_i: power that leaves the patch");
  ImGui::EndTable();
}

void sources(Viewer& viewer, const PatchInsight& p) {
  const Mesh& mesh = *viewer.state().snapshot->mesh;
  ImGui::TextUnformatted("Where most of it comes from");
  if (!ImGui::BeginTable("sources", 4, ImGuiTableFlags_NoPadOuterX)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
  for (int k = 0; k < 3; ++k) ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, channelWidth());
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted("patch j");
  tooltip(
      "Those that most of the light received at patch i comes from; lit in the picture while the mouse is "
      "over one");
  struct Column {
    const char *name, *tip;
  };
  static constexpr std::array<Column, 3> kColumns = {
      {{"G_ij",
        "Form factor: the part of i's view that patch j fills, 0 to 1. Also the part of i's light that "
        "arrives at j"},
       {"B_j green", "Radiosity of patch j, its green channel [W/m\u00b2]"},
       {"share",
        "G_ij B_j over \u2211 G_ij B_j, summed over the channels: the part of the light received that comes "
        "from j [%]"}}};
  for (const Column& column : kColumns) {
    ImGui::TableNextColumn();
    rightAligned(column.name);
    tooltip(column.tip);
  }
  for (const PatchSource& source : p.sources) {
    const bool sky = source.patch >= mesh.patch_count;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(sky ? "the sky" : patchText(mesh, source.patch).c_str());
    if (!sky && ImGui::IsItemHovered()) viewer.teaching().markPatch(source.patch, true, true);
    ImGui::TableNextColumn();
    rightAligned(channelText(source.factor));
    tooltip(kColumns[0].tip);
    ImGui::TableNextColumn();
    rightAligned(channelText(source.radiosity.y));
    tooltip(kColumns[1].tip);
    ImGui::TableNextColumn();
    const glm::dvec3 all = p.gathered, part = source.factor * source.radiosity;
    const double sum = all.x + all.y + all.z;
    rightAligned(percentText(sum > 0 ? (part.x + part.y + part.z) / sum : 0));
    tooltip(kColumns[2].tip);
  }
  ImGui::EndTable();
}

void shotRows(const ShotInsight& shot) {
  if (!beginChannelsAndUnits("shot")) return;
  row("A |U| before", shot.unshot_before, "W", "Unshot power of the patch before its shot");
  row("sent: A d", shot.sent, "W", "Power that it shot: d is the radiosity that it sent, A its area");
  row("= absorbed", shot.absorbed, "W",
      "What the surfaces it met keep: \u2211 A (1 \u2212 R) of what arrives");
  row("+ unshot now", shot.reflected, "W",
      "What they reflect and have still to shoot: \u2211 A R of what arrives");
  row("+ escaped", shot.escaped, "W", "What met no surface");
  row("+ defect", shot.defect, "W", "Lost (negative: gained) by approximate form factors");
  ImGui::EndTable();
}

void shotText(Viewer& viewer) {
  const Insight* insight = viewer.teaching().insight();
  const SessionState& state = viewer.state();
  const ShotInsight* shot = insight ? insight->shot.get() : nullptr;
  if (!shot) {
    dimmed(viewer.stepsFromNothing() ? "The solve has ended: Step begins again from nothing and shoots "
                                       "once, each further one once "
                                       "more; what that was is told here."
           : state.phase == SessionPhase::kConverged
               ? "The solve has converged: Again shoots anew from nothing, and Step then once at a time."
               : "Step shoots once: the patch with the most unshot power sends it all, and what that was is "
                 "told here.");
    return;
  }
  if (shot->moved == 0) {
    wrapped("The last step shot nothing: it computed or improved form factors.");
    return;
  }
  if (shot->moved > 1) {
    wrapped("The last step moved " + countedText(shot->moved, "patch", "patches") +
            " at once: this iteration mode does not shoot one by one.");
    return;
  }
  ImGui::TextUnformatted(
      ("Shot " + countText(shot->shots) + ": patch " + patchText(*state.snapshot->mesh, shot->patch))
          .c_str());
  shotRows(*shot);
}

struct Effect {
  const char* name;
  const char* shown;
  const char* why;
};

constexpr std::array<Effect, 11> kEffects = {{
    {"Colour bleeding", "yes",
     "A red wall reflects red light, and that is received like any other: R_i G_ij B_j per channel."},
    {"Indirect light", "yes", "The sum over all bounces, I + M + M\u00b2 + \u2026, is the solution itself."},
    {"Soft shadows", "yes",
     "Lamps have area: a point sees a part of it, and G_ij says which. As sharp as the mesh is fine."},
    {"View independence", "yes",
     "L = B / \u03c0 is the same in all directions: solved once, it is seen from everywhere."},
    {"Sun, hard shadows", "limits",
     "A small far lamp has shadow edges sharper than any element; the mesh blurs them."},
    {"Mirrors", "no", "A mirror sends light in one direction; R_i is one number for all directions."},
    {"Glossy reflection", "no", "It too depends on the direction: f would no longer be R / \u03c0."},
    {"Glass, refraction", "no", "Light that passes through a surface is no term of the equation."},
    {"Caustics", "no", "They are made by mirrors and glass."},
    {"Subsurface scattering", "no", "Light leaves where it arrived; here it would leave beside it."},
    {"Depth of field, motion blur", "camera",
     "Matters of the camera, not of the light: any picture of the solution could have them."},
}};

/// What follows goes on in the line where it is no wider than the room that is left there.
void goOn(float width) {
  const float right = ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + width;
  if (right <= ImGui::GetWindowPos().x + ImGui::GetContentRegionMax().x) ImGui::SameLine();
}

bool buttonBeside(const char* text) {
  goOn(ImGui::CalcTextSize(text).x + 2 * ImGui::GetStyle().FramePadding.x);
  return ImGui::Button(text);
}

}  // namespace

void equationPage(Viewer& viewer) {
  if (!viewer.picking().picked() || viewer.picking().picked()->pick.patch == kNone) {
    wrapped(
        "B_i = E_i + R_i \u2211 G_ij B_j. Click a surface to see it with the numbers of the patch there.");
    return;
  }
  const PatchInsight* p = viewer.teaching().patch();
  if (!p) {
    dimmed("\u2026");
    return;
  }
  const Mesh& mesh = *viewer.state().snapshot->mesh;
  ImGui::TextUnformatted(("Patch i: " + patchText(mesh, p->patch) + "; means over it").c_str());
  equationRows(*p);
  line("\u2211 G_ij",
       figureText(p->row_sum) + (p->missing > 0 ? ", " + countText(p->missing) + " columns missing" : ""),
       "Sum over the patches whose form factors are at hand: 1 where all that i sees is among them");
  sources(viewer, *p);
  wrapped("Power of the bounces M^k E, all patches together");
  bouncesContent(viewer);
}

void shotsPage(Viewer& viewer) {
  ImGui::BeginDisabled(!viewer.solveGoesOn() && !viewer.stepsFromNothing());
  if (ImGui::Button("Step")) viewer.perform("step");
  tooltip(viewer.stepsFromNothing() ? "N: begins again from nothing shot, and pauses after the first shot"
                                    : "N: the patch chosen next shoots, then the solve pauses");
  ImGui::EndDisabled();
  ImGui::BeginDisabled(!viewer.solveGoesOn());
  const bool paused = viewer.state().phase == SessionPhase::kPaused;
  if (buttonBeside(paused ? "Resume" : "Pause")) viewer.perform("pause");
  tooltip("Space");
  ImGui::EndDisabled();
  if (buttonBeside("Again")) viewer.perform("again");
  tooltip("From nothing shot, with the form factors at hand");
  const char* show = "Show it alone";
  goOn(ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x + ImGui::CalcTextSize(show).x);
  bool on = viewer.settings().view.display == "last-shot";
  if (ImGui::Checkbox(show, &on)) viewer.perform("display", on ? "last-shot" : "radiosity");
  tooltip("In the picture only what the last single step added to B, exposed to be seen (display last-shot)");
  shotText(viewer);
  ImGui::Separator();
  const float em = ImGui::GetFontSize();
  const float side = std::floor(std::min(ImGui::GetContentRegionAvail().x, 18 * em));
  const std::string shown = "Picture";
  label(shown.c_str(), "What the hemicube's pixels show");
  const HemicubeColours colours = viewer.teaching().choices.picture;
  for (const HemicubePictureRow& picture : hemicubePictures()) {
    if (picture.colours != colours) continue;
    const std::string key = choose("##shotpicture", hemicubePictures(), std::string(picture.info.key),
                                   std::string(picture.info.title), nullptr);
    if (!key.empty()) viewer.perform("hemicube-picture", key);
    break;
  }
  hemicubeContent(viewer, side);
}

void effectsPage() {
  wrapped("Radiosity follows light between diffuse surfaces, all of it, and nothing else.");
  const float em = ImGui::GetFontSize();
  const bool wide = ImGui::GetContentRegionAvail().x > kWideEffects * em;
  if (!ImGui::BeginTable("effects", wide ? 3 : 1, ImGuiTableFlags_NoPadOuterX | ImGuiTableFlags_RowBg))
    return;
  if (wide) {
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 8 * em);
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 3.5f * em);
  }
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
  for (const Effect& effect : kEffects) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    wrapped(effect.name);
    if (wide) ImGui::TableNextColumn();
    const bool yes = std::string_view(effect.shown) == "yes";
    ImGui::TextColored(yes ? ImVec4(0.5f, 0.85f, 0.5f, 1) : ImVec4(0.85f, 0.75f, 0.5f, 1), "%s",
                       effect.shown);
    if (wide) ImGui::TableNextColumn();
    wrapped(effect.why);
  }
  ImGui::EndTable();
}

}  // namespace unshot

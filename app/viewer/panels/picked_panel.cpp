#include "viewer/panels/picked_panel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.h"
#include "viewer/panels/marks.h"
#include "viewer/panels/race_panel.h"
#include "viewer/panels/widgets.h"

namespace unshot {
namespace {

/// A line whose value may be too long for it: then the tooltip has all of it.
void nameLine(const char* name, const std::string& value, const std::string& tip) {
  const std::string shown = shortened(value, ImGui::GetContentRegionAvail().x - 5.0f * ImGui::GetFontSize());
  line(name, shown, shown == value ? tip : value + "\n" + tip);
}

bool beginChannels(const char* id) {
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding,
                      {0.2f * ImGui::GetFontSize(), ImGui::GetStyle().CellPadding.y});
  const bool begun = ImGui::BeginTable(id, 4, ImGuiTableFlags_NoPadOuterX);
  ImGui::PopStyleVar();
  if (!begun) return false;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
  for (int k = 0; k < 3; ++k) ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, channelWidth());
  return true;
}

/// `unit`: of what has none in its name.
void channelNames(const char* unit) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", unit);
  for (const char* name : {"red", "green", "blue"}) {
    ImGui::TableNextColumn();
    rightAligned(name, true);
  }
}

void channels(std::string_view title, const std::optional<glm::dvec3>& value, std::string_view tip) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", std::string(title).c_str());
  tooltip(tip);
  for (int k = 0; k < 3; ++k) {
    ImGui::TableNextColumn();
    rightAligned(value ? channelText((*value)[k]) : "\u2013", false);
    tooltip(tip);
  }
}

void values(const PickedPoint& point, const Snapshot& snapshot) {
  if (beginChannels("picked")) {
    channelNames("in W/m\u00b2");
    for (const PickedQuantity& quantity : pickedQuantities()) {
      if (quantity.one_channel) continue;
      const auto value = quantity.of(point, snapshot);
      if (value) channels(quantity.title, value, quantity.tip);
    }
    ImGui::EndTable();
  }
  for (const PickedQuantity& quantity : pickedQuantities()) {
    if (!quantity.one_channel || point.pick.side == kNone) continue;
    const auto value = quantity.of(point, snapshot);
    const std::string unit = quantity.unit.empty() ? "" : " " + std::string(quantity.unit);
    line(std::string(quantity.title).c_str(), value ? figureText(value->x) + unit : "not known",
         quantity.tip);
  }
}

void cells(const PickedPoint& point, const Mesh& mesh) {
  if (point.pick.element == kNone) return;
  const auto text = [](std::uint32_t number, double area) {
    return "no. " + std::to_string(number) + ", " + figureText(area) + " m\u00b2";
  };
  line("Element", text(point.pick.element, mesh.element_area[point.pick.element]),
       "What receives light here, and its area A [m\u00b2]; counted from 0 over all lit sides");
  line("Patch", text(point.pick.patch, mesh.patch_area[point.pick.patch]),
       "What shoots light here, framed in the picture, and its area A [m\u00b2], the sum over its elements; "
       "counted "
       "from 0 over all lit sides");
}

void decisions(const PickedPoint& point) {
  if (point.decisions.empty()) {
    ImGui::BeginGroup();
    paragraph("Plan", "Nothing is left out here.");
    ImGui::EndGroup();
    tooltip(
        "What the solve does not compute for this surface, as the result is the same without it: nothing");
    return;
  }
  for (std::size_t k = 0; k < point.decisions.size(); ++k) {
    const PickedDecision& decision = point.decisions[k];
    ImGui::BeginGroup();
    paragraph(k == 0 ? "Plan" : "", decision.text);
    ImGui::EndGroup();
    const PlanRow& row = findChoice(planRows(), decision.key, "decision of the plan");
    tooltip("What the solve does not compute for this surface, as the result is the same without it: " +
            std::string(row.info.title) + "; " + std::string(row.sure) + ". More under \"Left out\"");
  }
}

void buttons(Viewer& viewer) {
  struct Choice {
    const char* text;
    const char* action;
    const char* tip;
  };
  static constexpr std::array<Choice, 4> kChoices = {
      {{"Look at", "focus-picked", "C: turns to this point and orbits around it"},
       {"Pin", "pin-probe", "P: keeps this point as a probe"},
       {"Copy", "copy-values", "Ctrl+C: all of this as text, a quantity a line"},
       {"Close", "unpick", "Esc, or a click beside the scene"}}};
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - 3 * gap) / 4;
  for (const Choice& choice : kChoices) {
    if (&choice != kChoices.data()) ImGui::SameLine();
    if (ImGui::Button(choice.text, {width, 0})) viewer.perform(choice.action);
    tooltip(choice.tip);
  }
}

/// What the picked surface is made of, to be changed.
void materialButtons(Viewer& viewer, const Material& material) {
  const float width = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
  const bool on = material.emits();
  if (ImGui::Button(on ? "Switch it off" : "Make it a light", {width, 0}))
    viewer.perform("light", material.name + (on ? " off" : " on"));
  tooltip(
      on ? "All surfaces of this material emit nothing. The solution follows; Ctrl+Z takes it back"
         : "All surfaces of this material emit, as they did before or white. The solution follows; Ctrl+Z "
           "takes it back");
  ImGui::SameLine();
  if (ImGui::Button("Change material", {width, 0})) viewer.perform("section", "materials on");
  tooltip("Opens the section Materials, with reflectance and emission of this one");
}

/// The row of a probe's name; false where it was given up.
bool probeHead(Viewer& viewer, std::size_t k) {
  const PinnedProbe& pinned = viewer.picking().pinned()[k];
  const ImGuiStyle& style = ImGui::GetStyle();
  const float button = ImGui::CalcTextSize("\u00d7").x + 2 * style.FramePadding.x;
  const std::string name = std::to_string(k + 1) + "  " + pinned.material;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(
      shortened(name, ImGui::GetContentRegionAvail().x - button - style.ItemSpacing.x).c_str());
  const glm::dvec3& normal = pinned.probe.normal;
  tooltip(pinned.material + "\nat " + positionText(pinned.probe.position) + " [m]\nfacing " +
          positionText(normal));
  ImGui::SameLine(ImGui::GetContentRegionMax().x - button);
  const bool gone = ImGui::Button("\u00d7");
  tooltip("Gives this probe up");
  if (gone) viewer.perform("unpin-probe", std::to_string(k + 1));
  return !gone;
}

// Marks: bright with a dark rim, to be seen on anything.

const ImU32 kBright = IM_COL32(255, 248, 235, 255), kShade = IM_COL32(0, 0, 0, 190);

void cross(ImDrawList& list, const ImVec2& at, float size) {
  for (const bool shade : {true, false}) {
    const ImU32 colour = shade ? kShade : kBright;
    const float thick = (shade ? 0.25f : 0.11f) * size;
    list.AddCircle(at, 0.5f * size, colour, 24, thick);
    for (const ImVec2 d : {ImVec2(1, 0), ImVec2(-1, 0), ImVec2(0, 1), ImVec2(0, -1)}) {
      list.AddLine({at.x + 0.5f * size * d.x, at.y + 0.5f * size * d.y},
                   {at.x + 0.95f * size * d.x, at.y + 0.95f * size * d.y}, colour, thick);
    }
  }
}

void markPicked(ImDrawList& list, const MarkedPicture& picture, const PickedPoint& point, float size) {
  markOutline(list, picture, point.outline, kBright);
  if (const auto at = picture.at(point.pick.position)) cross(list, *at, size);
}

void markProbe(ImDrawList& list, const ImVec2& at, const std::string& number, float size) {
  list.AddCircleFilled(at, 0.28f * size, kShade);
  list.AddCircleFilled(at, 0.2f * size, kBright);
  const ImVec2 beside(at.x + 0.4f * size, at.y - 1.1f * size);
  list.AddText({beside.x + 1, beside.y + 1}, kShade, number.c_str());
  list.AddText(beside, kBright, number.c_str());
}

}  // namespace

void pickedSection(Viewer& viewer) {
  if (!viewer.picking().picked() || !sectionOfLeft("Picked", viewer.state())) return;
  const PickedPoint& point = *viewer.picking().picked();
  const Snapshot& snapshot = *viewer.state().snapshot;
  const Surface& surface = snapshot.mesh->surfaces[point.pick.surface];
  nameLine("Material", snapshot.mesh->materials[surface.material].name,
           "As the scene's file names it; what it reflects and emits is changed under \"Materials\"");
  line("Surface", surfaceText(point.pick),
       "Connected polygons of one plane and material, counted from 0, and the side that is seen: front is "
       "where the "
       "corners of its polygons run counter-clockwise");
  line("In the file", "line " + std::to_string((*viewer.state().facts->surface_lines)[point.pick.surface]),
       "Line number, counted from 1, where the scene's file has one of the surface's polygons");
  line("Position", positionText(point.probe.position) + " m",
       "x, y and z in the coordinates of the scene's file [m]");
  cells(point, *snapshot.mesh);
  values(point, snapshot);
  decisions(point);
  buttons(viewer);
  materialButtons(viewer, snapshot.mesh->materials[surface.material]);
  ImGui::Spacing();
}

void probesSection(Viewer& viewer) {
  const std::size_t count = viewer.picking().pinned().size();
  if (count == 0) return;
  const std::string title = "Probes (" + std::to_string(count) + ")";
  if (!section((title + (viewer.state().rival ? ", left picture" : "") + "###probes").c_str())) return;
  const Snapshot& snapshot = *viewer.state().snapshot;
  for (std::size_t k = 0; k < viewer.picking().pinned().size(); ++k) {
    ImGui::PushID(static_cast<int>(k));
    if (probeHead(viewer, k) && beginChannels("values")) {
      channelNames("in W/m\u00b2");
      const std::optional<ProbePlace>& place = viewer.picking().pinned()[k].place;
      channels("Radiosity B", radiosityAt(place, snapshot),
               "B = E + \u03c1 H [W/m\u00b2], red, green and blue; what Save CSV writes");
      channels("Irradiance H", irradianceAt(place, snapshot),
               "Light received [W/m\u00b2], red, green and blue");
      ImGui::EndTable();
    }
    ImGui::PopID();
  }
  const float width = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
  if (ImGui::Button("Save CSV", {width, 0})) viewer.perform("save-probes");
  tooltip(
      "Writes positions, normals and B of all probes in the working folder, as unshot solve --probe-out "
      "does");
  ImGui::SameLine();
  if (ImGui::Button("Give up all", {width, 0})) viewer.perform("clear-probes");
  ImGui::Spacing();
}

void forEachMarkedPicture(const Viewer& viewer, int scene_width,
                          const std::function<void(ImDrawList&, const MarkedPicture&)>& draw) {
  const SceneSplit split = splitScene(scene_width, viewer.state().rival.has_value());
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float height = ImGui::GetIO().DisplaySize.y;
  for (const bool second : {false, true}) {
    if (second && split.right == 0) break;
    const MarkedPicture picture{viewer.markedCamera(), second ? static_cast<float>(split.right_at) : 0,
                                static_cast<float>(second ? split.right : split.left), height};
    list.PushClipRect({picture.left, 0}, {picture.left + picture.width, height});
    draw(list, picture);
    list.PopClipRect();
  }
}

void markOutline(ImDrawList& list, const MarkedPicture& picture,
                 std::span<const std::pair<glm::vec3, glm::vec3>> edges, ImU32 colour) {
  const float size = ImGui::GetFontSize();
  for (const auto& [a, b] : edges) {
    const auto from = picture.at(glm::dvec3(a)), to = picture.at(glm::dvec3(b));
    if (!from || !to) continue;
    list.AddLine(*from, *to, kShade, 0.2f * size);
    list.AddLine(*from, *to, colour, 0.1f * size);
  }
}

void markFilled(ImDrawList& list, const MarkedPicture& picture, std::span<const glm::vec3> corners,
                ImU32 colour) {
  // Softened edges would show where triangles meet.
  const ImDrawListFlags flags = list.Flags;
  list.Flags &= ~ImDrawListFlags_AntiAliasedFill;
  for (std::size_t k = 0; k + 2 < corners.size(); k += 3) {
    const auto a = picture.at(glm::dvec3(corners[k])), b = picture.at(glm::dvec3(corners[k + 1])),
               c = picture.at(glm::dvec3(corners[k + 2]));
    if (a && b && c) list.AddTriangleFilled(*a, *b, *c, colour);
  }
  list.Flags = flags;
}

void buildMarks(const Viewer& viewer, int scene_width) {
  const Picking& picking = viewer.picking();
  if (!picking.picked() && picking.pinned().empty()) return;
  const float size = ImGui::GetFontSize();
  const glm::dvec3& origin = viewer.state().snapshot->mesh->frame_origin;
  forEachMarkedPicture(viewer, scene_width, [&](ImDrawList& list, const MarkedPicture& picture) {
    if (picking.picked()) markPicked(list, picture, *picking.picked(), size);
    for (std::size_t k = 0; k < picking.pinned().size(); ++k) {
      if (const auto at = picture.at(picking.pinned()[k].probe.position - origin))
        markProbe(list, *at, std::to_string(k + 1), size);
    }
  });
}

}  // namespace unshot

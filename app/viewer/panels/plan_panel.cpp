#include "viewer/panels/plan_panel.h"

#include <algorithm>

#include "viewer/panels/widgets.h"

namespace unshot {
namespace {

void planSwitch(Viewer& viewer, const char* text, const std::string& action, const std::string& key,
                bool on) {
  if (ImGui::Checkbox(text, &on)) viewer.perform(action, key + (on ? "on" : "off"));
}

void planLine(Viewer& viewer, const PlanLine& line) {
  ImGui::PushID(line.key.c_str());
  const std::string title =
      brokenText(line.title, ImGui::GetContentRegionAvail().x - ImGui::GetTreeNodeToLabelSpacing());
  if (!line.left_out) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  const bool open = ImGui::TreeNodeEx((title + "###line").c_str(), ImGuiTreeNodeFlags_SpanAvailWidth);
  if (!line.left_out) ImGui::PopStyleColor();
  if (open) {
    paragraph(line.left_out ? "Why" : "What", line.why);
    if (!line.saving.empty()) paragraph("Saves", line.saving);
    paragraph("Sure", line.sure);
    planSwitch(viewer, "Do it all the same", "do", line.key + " ",
               !leavesOut(viewer.ui().options.do_anyway, line.key));
    tooltip("Solves again from the start, with it or without. On the command line: --do " + line.key);
    ImGui::Spacing();
    ImGui::TreePop();
  }
  ImGui::PopID();
}

}  // namespace

std::vector<PlanLine> planLines(const SolveFacts& facts) {
  std::vector<PlanLine> out;
  for (const PlanRow& row : planRows()) {
    const std::string key(row.info.key), sure(row.sure);
    const auto found = std::find_if(facts.plan.begin(), facts.plan.end(),
                                    [&](const PlanDecision& d) { return d.key == key; });
    if (found != facts.plan.end()) {
      out.push_back({key, found->what, found->why, found->saving, sure, true});
    } else if (!leavesOut(facts.options.do_anyway, key)) {
      out.push_back({key,
                     "done all the same: " + std::string(row.info.title),
                     std::string(row.info.help),
                     {},
                     sure,
                     false});
    }
  }
  return out;
}

void planSection(Viewer& viewer) {
  if (!viewer.state().facts) return;
  const std::vector<PlanLine> lines = planLines(*viewer.state().facts);
  if (lines.empty()) return;
  const auto left_out = static_cast<std::size_t>(
      std::count_if(lines.begin(), lines.end(), [](const PlanLine& line) { return line.left_out; }));
  std::string title = "Left out (" + std::to_string(left_out) + ")";
  if (left_out < lines.size())
    title += ", done all the same (" + std::to_string(lines.size() - left_out) + ")";
  ImGui::SetNextItemOpen(viewer.ui().left_out);
  const bool open = ImGui::CollapsingHeader((title + "###plan").c_str());
  if (open != viewer.ui().left_out) viewer.perform("left-out", open ? "on" : "off");
  if (!open) return;
  for (const PlanLine& line : lines) planLine(viewer, line);
  planSwitch(viewer, "Do everything all the same", "do-all", "", doesAll(viewer.ui().options.do_anyway));
  tooltip(
      "Solves again from the start, with all that a plan could leave out but shooters, or without. On the "
      "command line: "
      "--do-all");
}

}  // namespace unshot

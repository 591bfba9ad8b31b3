#include "viewer/panels/notes_panel.h"

#include <algorithm>

#include "base/text.h"
#include "viewer/panels/widgets.h"
#include "viewer/window_words.h"

namespace unshot {
namespace {

const ImVec4 kWarning{0.98f, 0.72f, 0.25f, 1};
const ImVec4 kNote{0.6f, 0.6f, 0.6f, 1};

/// Of the solve, and in a race of the other one; warnings first.
Diagnostics notesOf(const SessionState& state) {
  Diagnostics notes = state.facts->diagnostics;
  if (state.rival) {
    for (const Diagnostic& d : state.rival->facts->diagnostics) {
      const bool known = std::any_of(notes.begin(), notes.end(),
                                     [&](const Diagnostic& n) { return n.message == d.message; });
      if (!known) notes.push_back(d);
    }
  }
  std::stable_sort(notes.begin(), notes.end(),
                   [](const Diagnostic& a, const Diagnostic& b) { return a.severity > b.severity; });
  return notes;
}

std::size_t warningsAmong(const Diagnostics& notes) {
  return static_cast<std::size_t>(std::count_if(
      notes.begin(), notes.end(), [](const Diagnostic& d) { return d.severity == Severity::kWarning; }));
}

/// The folder of a place is too long to read here, and the same for all.
std::string shortPlace(const std::string& where) { return std::filesystem::path(where).filename().string(); }

void note(const Diagnostic& d) {
  const float indent = 0.8f * ImGui::GetFontSize();
  ImGui::BeginGroup();
  dot(d.severity == Severity::kWarning ? kWarning : kNote);
  wrapped(windowWords(d.message));
  ImGui::Indent(indent);
  if (!d.where.empty()) dimmed(shortPlace(d.where));
  if (!d.advice.empty()) dimmed("Try: " + windowWords(d.advice));
  ImGui::Unindent(indent);
  ImGui::EndGroup();
  tooltip(d.where.empty() ? d.code : d.code + ", " + d.where);
  ImGui::Spacing();
}

void noteList(Viewer& viewer, const Diagnostics& notes, const std::string& title) {
  ImGui::SetNextItemOpen(viewer.ui().notes);
  const bool open = ImGui::CollapsingHeader((title + "###notes").c_str());
  if (open != viewer.ui().notes) viewer.perform("notes", open ? "on" : "off");
  if (!open) return;
  for (const Diagnostic& d : notes) note(d);
}

}  // namespace

void warningsSection(Viewer& viewer) {
  if (!viewer.state().facts) return;
  const Diagnostics notes = notesOf(viewer.state());
  const std::size_t warnings = warningsAmong(notes);
  if (warnings == 0) return;
  std::string title = countedText(warnings, "warning");
  if (notes.size() > warnings) title += ", " + countedText(notes.size() - warnings, "note");
  // Only the heading.
  ImGui::PushStyleColor(ImGuiCol_Header, ImVec4(0.36f, 0.26f, 0.09f, 1));
  ImGui::PushStyleColor(ImGuiCol_HeaderHovered, ImVec4(0.45f, 0.33f, 0.12f, 1));
  noteList(viewer, notes, title + " on the scene");
  ImGui::PopStyleColor(2);
}

void notesSection(Viewer& viewer) {
  const SessionState& state = viewer.state();
  if (!state.facts) return;
  const Diagnostics notes = notesOf(state);
  if (!notes.empty() && warningsAmong(notes) == 0)
    noteList(viewer, notes, "Notes on the scene (" + std::to_string(notes.size()) + ")");
}

}  // namespace unshot

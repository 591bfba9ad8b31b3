// The sections of the panel, one row each: what opens them by name, and in which order they stand.
#pragma once

#include <span>

#include "base/choice.h"
#include "viewer/viewer.h"

namespace unshot {

struct PanelSection {
  ChoiceInfo info;
  void (*build)(Viewer& viewer);  ///< nothing where there is nothing to show
  /// Whether it is open: a switch of its own, or what ImGui keeps for the header of this label.
  bool ViewerState::*open = nullptr;
  const char* label = nullptr;
  bool at_first = false;  ///< open where nobody has opened or closed it yet
};
std::span<const PanelSection> panelSections();

/// Opens or closes the section (none: the other way) in the next frame that has the panel; one that is opened
/// is scrolled to. Throws a usage Error for a key that there is not.
void openSection(ViewerState& ui, const std::string& key, std::optional<bool> open);

/// All of them, in the window that is being built.
void buildSections(Viewer& viewer);

}  // namespace unshot

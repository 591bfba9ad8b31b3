// The viewer's panel and what is in it.
#pragma once

#include <imgui_internal.h>

#include <algorithm>
#include <string>

#include "viewer/panels/sections.h"

namespace unshot::testing_support {

inline constexpr int kPanel = 320;  ///< its width at scale 1, as app/viewer/panels/panels.cpp has it [px]

/// What is written as "a/b": b, with a pushed as an identity before it.
inline ImGuiID idOf(const std::string& path, ImGuiID within) {
  for (std::size_t at = 0; at <= path.size();) {
    const std::size_t end = std::min(path.find('/', at), path.size());
    within = ImHashStr(path.c_str() + at, end - at, within);
    at = end + 1;
  }
  return within;
}

/// For tests of what is in them: all but those that have a switch of their own, and the messages.
inline void openSections(Viewer& viewer) {
  for (const PanelSection& section : panelSections()) {
    if (!section.open && section.info.key != "messages")
      openSection(viewer.ui(), std::string(section.info.key), true);
  }
}

}  // namespace unshot::testing_support

#include "viewer/actions/actions.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <vector>

#include "base/error.h"
#include "base/parse.h"
#include "viewer/actions/action_groups.h"
#include "viewer/file_kinds.h"

namespace unshot {

std::span<const ActionGroup> actionGroups() {
  static const std::array<ActionGroup, 7> groups = {{
      {"Solve", solveActions()},
      {"Materials", materialActions()},
      {"Display", displayActions()},
      {"Picking", pickingActions()},
      {"Lecture", lectureActions()},
      {"Camera", cameraActions()},
      {"Window", windowActions()},
  }};
  return groups;
}

std::span<const Action> actions() {
  static const std::vector<Action> all = [] {
    std::vector<Action> rows;
    for (const ActionGroup& group : actionGroups())
      rows.insert(rows.end(), group.actions.begin(), group.actions.end());
    return rows;
  }();
  return all;
}

const Action& findAction(std::string_view key) {
  for (const Action& action : actions()) {
    if (action.key == key) return action;
  }
  std::string keys = "wait";
  for (const Action& action : actions()) keys += ", " + std::string(action.key);
  throw Error(ErrorKind::kUsage, "there is no action '" + std::string(key) + "'", {}, "one of: " + keys);
}

std::vector<std::string_view> Action::choices() const {
  if (argument.find('|') == std::string_view::npos) return {};
  std::string_view text = argument;
  if (text.front() == '[') text = text.substr(1, text.size() - 2);
  return splitParts(text, '|');
}

std::string Action::argumentOfKey(int pressed) const {
  if (shortcut.count == 1) return {};
  return std::string(choices()[static_cast<std::size_t>(pressed - shortcut.key)]);
}

std::string checkArgument(const Action& action, const std::string& argument) {
  if (action.argument.empty()) {
    return argument.empty() ? "" : "'" + std::string(action.key) + "' takes no argument";
  }
  if (argument.empty() && action.needsArgument())
    return "'" + std::string(action.key) + "' needs " + std::string(action.argument);
  return action.check ? action.check(argument) : "";
}

std::string_view actionOfFile(const std::filesystem::path& file) {
  return isTaken(file) ? kindOfFile(file)->action : "open";
}

std::filesystem::path chosenFile(std::span<const char* const> files) {
  auto found = std::find_if(files.begin(), files.end(), isScene);
  if (found == files.end()) found = std::find_if(files.begin(), files.end(), isTaken);
  return found == files.end() ? files.front() : *found;
}

int keyOfActions(int key, const char* printed, bool ctrl) {
  constexpr std::string_view kFlight = "WASDQE";
  const bool flies = key > 0 && key < 128 && kFlight.find(static_cast<char>(key)) != std::string_view::npos;
  if (ctrl ? key >= GLFW_KEY_0 && key <= GLFW_KEY_9 : flies) return key;
  // Keys without a sign, and those of other alphabets, which have the Latin letters of their places too.
  const std::string_view sign = printed ? printed : "";
  if (sign.size() != 1) return key;
  const char c = sign.front();
  if (c >= 'a' && c <= 'z') return c - 'a' + GLFW_KEY_A;
  if (c == '+' || c == '=') return GLFW_KEY_EQUAL;
  return (c >= '0' && c <= '9') || c == '-' ? c : 0;
}

const Action* actionOfKey(int key, bool ctrl) {
  if (key == GLFW_KEY_KP_ADD) key = GLFW_KEY_EQUAL;
  if (key == GLFW_KEY_KP_SUBTRACT) key = GLFW_KEY_MINUS;
  for (const Action& action : actions()) {
    const Shortcut& shortcut = action.shortcut;
    if (shortcut.key != 0 && key >= shortcut.key && key < shortcut.key + shortcut.count &&
        shortcut.ctrl == ctrl)
      return &action;
  }
  return nullptr;
}

}  // namespace unshot

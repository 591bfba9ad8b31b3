// The table of named actions: what keys, buttons and scripts can do. A new action is a row in the file of its
// group (solve_actions.cpp, display_actions.cpp ...).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/choice.h"

namespace unshot {

class Viewer;

/// A key as GLFW numbers it (letters and digits are their ASCII codes); 0: none.
struct Shortcut {
  int key = 0;
  bool ctrl = false;
  std::string_view text;  ///< as shown: "Ctrl+F12"
  int count = 1;          ///< more: so many keys from this one on stand for the choices of the argument
};

struct Action {
  std::string_view key;  ///< name in scripts
  /// Placeholder in help, "[N]" where it may be missing, "a|b" for choices; empty: takes none.
  std::string_view argument;
  std::string_view help;  ///< one line
  Shortcut shortcut;      ///< performs it without argument, or with one of its choices
  /// Throws Error (kUsage) for an argument that it cannot use.
  void (*run)(Viewer& viewer, const std::string& argument);
  /// Empty where the argument is one that run() may take, else what is wrong with it; for checking scripts
  /// before they run. Null: any text, none only where `argument` is empty or in brackets.
  std::string (*check)(const std::string& argument) = nullptr;
  /// A script waits with it until the scene is loaded, framed, and earlier commands are carried out.
  bool when_settled = false;
  /// Rows of the table that the argument is a key of; null where it is none.
  std::vector<ChoiceInfo> (*rows)() = nullptr;

  bool needsArgument() const { return !argument.empty() && argument.front() != '['; }
  /// Of the argument; empty where it is no choice.
  std::vector<std::string_view> choices() const;
  /// What the key, one of the shortcut's, gives it.
  std::string argumentOfKey(int pressed) const;
};

/// Actions of one matter, as lists show them.
struct ActionGroup {
  std::string_view title;
  std::span<const Action> actions;
};

std::span<const ActionGroup> actionGroups();

/// All of them, group after group.
std::span<const Action> actions();

/// Throws a usage Error that lists them.
const Action& findAction(std::string_view key);

/// What is wrong with an action's argument, or nothing.
std::string checkArgument(const Action& action, const std::string& argument);

/// The action for a file that was dropped on the window or chosen: `open`, which says what is wrong with it,
/// where no other takes it.
std::string_view actionOfFile(const std::filesystem::path& file);

/// Of files that were dropped together, at least one: the first scene, else the first that an action takes,
/// else the first.
std::filesystem::path chosenFile(std::span<const char* const> files);

/// The key that actions go by, for one that is pressed: what is printed on it (GLFW's name of it, which may
/// be null) wherever a keyboard has that. Keys of flying stay where they are, and with Ctrl so do those of
/// digits, on which some keyboards have other signs. 0: none.
int keyOfActions(int key, const char* printed, bool ctrl);

/// The action that a key stands for, or null.
const Action* actionOfKey(int key, bool ctrl);

}  // namespace unshot

// Actions that go with a text, for a list to choose from.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "viewer/actions/actions.h"

namespace unshot {

/// The text begins with the name of an action and a blank: what stands behind it is its argument.
struct TypedAction {
  const Action* action = nullptr;  ///< null: the text names none so far
  std::string argument;
};
TypedAction typedAction(std::string_view text);

/// An action, or one with a choice of its argument.
struct FoundAction {
  const Action* action = nullptr;
  std::string argument;  ///< key of the choice; empty: none
  std::string title;     ///< of the choice
};

/// The actions that have all words of the text in their name, argument, help or the title of their group:
/// first the one of this name, then those whose name begins with the text, those that have it there, and the
/// others, each in the order of the table. Behind those whose name has the text come choices whose name or
/// title has all of it; of an action that is typed, those that have what stands behind its name.
std::vector<FoundAction> matchingActions(std::string_view text);

}  // namespace unshot

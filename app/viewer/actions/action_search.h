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

/// The actions that have all words of the text in their name, argument, help or the title of their group:
/// first the one of this name, then those whose name begins with the text, those that have it there, and the
/// others, each in the order of the table.
std::vector<const Action*> matchingActions(std::string_view text);

}  // namespace unshot

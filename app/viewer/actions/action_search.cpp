#include "viewer/actions/action_search.h"

#include <algorithm>
#include <array>

#include "base/parse.h"
#include "viewer/file_list.h"

namespace unshot {
namespace {

bool hasAllWords(const std::string& where, const std::string& text) {
  for (const std::string_view word : splitParts(text, ' ')) {
    if (where.find(word) == std::string::npos) return false;
  }
  return true;
}

}  // namespace

TypedAction typedAction(std::string_view text) {
  const std::size_t space = text.find(' ');
  if (space == std::string_view::npos) return {};
  for (const Action& action : actions()) {
    if (action.key == text.substr(0, space)) return {&action, std::string(trimmed(text.substr(space)))};
  }
  return {};
}

std::vector<const Action*> matchingActions(std::string_view text) {
  const std::string wanted = lowered(trimmed(text));
  std::array<std::vector<const Action*>, 4> found;
  for (const ActionGroup& group : actionGroups()) {
    for (const Action& action : group.actions) {
      const std::string key(action.key);
      const std::size_t at = key.find(wanted);
      const std::string all =
          key + " " + lowered(action.argument) + " " + lowered(action.help) + " " + lowered(group.title);
      if (key == wanted) {
        found[0].push_back(&action);
      } else if (at == 0) {
        found[1].push_back(&action);
      } else if (at != std::string::npos) {
        found[2].push_back(&action);
      } else if (hasAllWords(all, wanted)) {
        found[3].push_back(&action);
      }
    }
  }
  std::vector<const Action*> rows;
  for (const auto& some : found) rows.insert(rows.end(), some.begin(), some.end());
  // actionGroups() and actions() hold the same rows; what is found is of the latter.
  for (const Action*& row : rows) row = &findAction(row->key);
  return rows;
}

}  // namespace unshot

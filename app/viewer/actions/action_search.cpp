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

/// The choices whose key or title has all words of the text, and those of which it is one of both.
void addChoices(const Action& action, const std::string& text, std::vector<FoundAction>& rows,
                std::vector<FoundAction>& same) {
  if (!action.rows) return;
  for (const ChoiceInfo& choice : action.rows()) {
    const std::string title = lowered(choice.title);
    if (hasAllWords(std::string(choice.key) + " " + title, text))
      (choice.key == text || title == text ? same : rows)
          .push_back({&action, std::string(choice.key), std::string(choice.title)});
  }
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

namespace {

/// Words that other programs have for what is called otherwise here.
struct OtherWord {
  std::string_view word, here;
};
constexpr std::array<OtherWord, 25> kOtherWords = {{{"wireframe", "mesh"},
                                                    {"field", "angle"},
                                                    {"reset", "back"},
                                                    {"view", "camera"},
                                                    {"make", "light"},
                                                    {"it", ""},
                                                    {"a", ""},
                                                    {"this", ""},
                                                    {"grid", "mesh"},
                                                    {"color", "colour"},
                                                    {"colors", "colour"},
                                                    {"heatmap", "false colour"},
                                                    {"heat", "false"},
                                                    {"save", "write"},
                                                    {"export", "write"},
                                                    {"image", "png"},
                                                    {"picture", "png"},
                                                    {"brightness", "exposure"},
                                                    {"gamma", "tone"},
                                                    {"albedo", "reflectance"},
                                                    {"wall", "material"},
                                                    {"zoom", "camera"},
                                                    {"lamp", "light"},
                                                    {"exit", "quit"},
                                                    {"close", "quit"}}};

// Of such a word, at least, before it is taken for one.
constexpr std::size_t kTypedLetters = 4;

std::string inWordsOfHere(const std::string& text) {
  std::string out;
  for (const std::string_view word : splitParts(text, ' ')) {
    // Also before its last letters are typed.
    const auto other = std::find_if(kOtherWords.begin(), kOtherWords.end(), [&](const OtherWord& o) {
      return o.word == word || (word.size() >= kTypedLetters && o.word.starts_with(word));
    });
    const std::string_view here = other == kOtherWords.end() ? word : other->here;
    out += (out.empty() || here.empty() ? "" : " ") + std::string(here);
  }
  return out;
}

std::vector<FoundAction> actionsWith(const std::string& wanted) {
  enum Rank { kSame, kBegins, kHas, kSameChoice, kChoice, kSays, kRanks };
  std::array<std::vector<FoundAction>, kRanks> found;
  for (const ActionGroup& group : actionGroups()) {
    for (const Action& row : group.actions) {
      // actionGroups() and actions() hold the same rows; what is found is of the latter.
      const Action& action = findAction(row.key);
      const std::string key(action.key);
      const std::size_t at = key.find(wanted);
      const std::string all =
          key + " " + lowered(action.argument) + " " + lowered(action.help) + " " + lowered(group.title);
      if (key == wanted) {
        found[kSame].push_back({&action, {}, {}});
      } else if (at == 0) {
        found[kBegins].push_back({&action, {}, {}});
      } else if (at != std::string::npos) {
        found[kHas].push_back({&action, {}, {}});
      } else if (hasAllWords(all, wanted)) {
        found[kSays].push_back({&action, {}, {}});
      }
      if (!wanted.empty()) addChoices(action, wanted, found[kChoice], found[kSameChoice]);
    }
  }
  std::vector<FoundAction> rows;
  for (const auto& some : found) rows.insert(rows.end(), some.begin(), some.end());
  return rows;
}

}  // namespace

std::vector<FoundAction> matchingActions(std::string_view text) {
  const TypedAction typed = typedAction(text);
  if (typed.action) {
    std::vector<FoundAction> rows;
    addChoices(*typed.action, lowered(typed.argument), rows, rows);
    const bool whole = std::any_of(rows.begin(), rows.end(),
                                   [&](const FoundAction& row) { return row.argument == typed.argument; });
    if (whole || rows.empty()) return {{typed.action, typed.argument, {}}};
    return rows;
  }
  const std::string wanted = lowered(trimmed(text));
  std::vector<FoundAction> rows = actionsWith(wanted);
  return rows.empty() ? actionsWith(inWordsOfHere(wanted)) : rows;
}

}  // namespace unshot

// Tables of choices: iteration modes, form-factor methods, display modes, exporters, GL providers. A choice
// is one file and one row; command line, `unshot list`, GUI and parametrised tests read the table.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/error.h"

namespace unshot {

/// The part that every table shares: key (as typed), title (as shown), one line of help.
struct ChoiceInfo {
  std::string_view key;
  std::string_view title;
  std::string_view help;
};

/// The row of `table` whose info.key is `key`. Throws a usage Error that lists the keys.
template <class Row>
const Row& findChoice(std::span<const Row> table, std::string_view key, std::string_view what) {
  std::string keys;
  for (const Row& row : table) {
    if (row.info.key == key) return row;
    keys += (keys.empty() ? "" : ", ") + std::string(row.info.key);
  }
  throw Error(ErrorKind::kUsage, "there is no " + std::string(what) + " '" + std::string(key) + "'", {},
              "one of: " + keys);
}

}  // namespace unshot

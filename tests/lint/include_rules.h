// The house rules about includes, as a table: which folder may see which, and where each third-party header
// is at home.
#pragma once

#include <string>
#include <vector>

namespace unshot::lint {

/// A source file of the repository: its path from the root, with slashes.
struct Source {
  std::string path;
  std::string text;
};

/// One broken rule, worded "path:line: ...".
using Complaints = std::vector<std::string>;

/// Checks files of core/ and app/.
Complaints checkIncludes(const Source& source);

}  // namespace unshot::lint

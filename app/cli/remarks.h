// Remarks on a scene as a table, for `unshot check`.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>

#include "base/diagnostic.h"

namespace unshot {

/// Warnings first, then by file and line; remarks without a place at the end of their kind.
void sortRemarks(Diagnostics& remarks);

/// Columns of severity, code and place; below each what was found and what to do, wrapped at `width` columns.
void printRemarks(std::ostream& out, const Diagnostics& remarks, std::size_t width);

/// The text in lines of at most `width` columns, the first after `first`, the others after as many blanks.
/// Words that are longer stay whole.
std::string wrapped(const std::string& first, const std::string& text, std::size_t width);

/// Columns of the terminal behind standard output; 100 where there is none.
std::size_t outputWidth();

}  // namespace unshot

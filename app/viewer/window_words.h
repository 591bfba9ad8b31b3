// Messages of the solver and of scene checks, in the words of the window: what they advise with options of
// the command line is there done with a control.
#pragma once

#include <string>

#include "base/error.h"

namespace unshot {

/// Units and advice as the window has them.
std::string windowWords(std::string text);

/// The same for an error's message and advice.
Error inWindowWords(const Error& error);

}  // namespace unshot

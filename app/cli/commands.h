// The sub-commands, one file each: what they take, and what they do.
#pragma once

#include "cli/options.h"

namespace unshot {

/// Each adds its options to `command` and sets command.run.
void setUpView(Command& command);
void setUpSolve(Command& command);
void setUpReport(Command& command);
void setUpCheck(Command& command);
void setUpCompare(Command& command);
void setUpList(Command& command);
void setUpSelftest(Command& command);

}  // namespace unshot

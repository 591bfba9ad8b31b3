// Unshot: a live radiosity viewer. The one place that turns an error into a message and an exit code.
#include <csignal>
#include <iostream>

#include "base/error.h"
#include "cli/command_line.h"
#include "exit_codes.h"

int main(int argc, char** argv) {
  // Neither a reader of our output that goes away nor a file that may grow no further costs the result of a
  // long solve.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return unshot::runCommandLine(argc, argv);
  } catch (...) {
    const unshot::Error error = unshot::presentError();
    std::cout.flush();
    std::cerr << "unshot: " << error.fullText() << std::endl;
    return unshot::exitCodeOf(error.kind());
  }
}

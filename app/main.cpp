// Unshot: a live radiosity viewer. The one place that turns an error into a message and an exit code.
#include <csignal>
#include <exception>
#include <iostream>
#include <new>

#include "cli/command_line.h"
#include "exit_codes.h"

namespace {

int report(const std::string& text, int code) {
  std::cout.flush();
  std::cerr << "unshot: " << text << std::endl;
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  // Neither a reader of our output that goes away nor a file that may grow no further costs the result of a
  // long solve.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return unshot::runCommandLine(argc, argv);
  } catch (const unshot::Error& error) {
    return report(error.fullText(), unshot::exitCodeOf(error.kind()));
  } catch (const std::bad_alloc&) {
    return report("out of memory\n  try: a coarser mesh (--elements) or a smaller picture (--size)",
                  unshot::kExitEnvironment);
  } catch (const std::exception& error) {
    return report(std::string("internal error: ") + error.what() +
                      "\n  try: please report it with the command and the scene",
                  unshot::kExitInternal);
  }
}

#include <algorithm>
#include <iostream>
#include <span>
#include <string>
#include <vector>

#include "base/tone.h"
#include "cli/commands.h"
#include "exit_codes.h"
#include "export/exporters.h"
#include "formfactor/methods.h"
#include "gl/context.h"
#include "render/display_modes.h"
#include "session/scene_checks.h"
#include "session/scene_plan.h"
#include "solver/modes.h"
#include "viewer/actions/actions.h"
#include "viewer/glfw_context.h"

namespace unshot {
namespace {

/// One table: the option that takes its keys, and a row each: key, title, help, and why it cannot be had on
/// this machine.
template <class Row, class Unavailable>
void printTable(const std::string& title, std::span<const Row> table, const std::string& prefix,
                Unavailable unavailable) {
  std::size_t key_width = 0, title_width = 0;
  for (const Row& row : table) {
    key_width = std::max(key_width, prefix.size() + row.info.key.size());
    title_width = std::max(title_width, row.info.title.size());
  }
  std::cout << title << "\n";
  for (const Row& row : table) {
    const std::string key = prefix + std::string(row.info.key);
    std::cout << "  " << key << std::string(key_width - key.size() + 2, ' ') << row.info.title
              << std::string(title_width - row.info.title.size() + 2, ' ') << row.info.help << "\n";
    const std::string reason = unavailable(row);
    if (!reason.empty())
      std::cout << std::string(key_width + 4, ' ') << "not available here: " << reason << "\n";
  }
  std::cout << "\n";
}

/// What scripts of the viewer are made of, each with its key.
void printActions() {
  std::size_t width = 0;
  for (const Action& action : actions())
    width = std::max(width, action.key.size() + 1 + action.argument.size());
  std::cout << "Actions of the viewer (a line each in --script)\n";
  for (const Action& action : actions()) {
    const std::string call = std::string(action.key) + " " + std::string(action.argument);
    std::cout << "  " << call << std::string(width - call.size() + 2, ' ') << action.help;
    if (action.shortcut.key != 0) std::cout << " [" << action.shortcut.text << "]";
    std::cout << "\n";
  }
  std::cout << "\n";
}

int runList() {
  const auto available = [](const auto&) { return std::string(); };
  printTable("Iteration modes (--mode)", iterationModes(), "", available);
  printTable("Form-factor methods (--form-factors)", formFactorMethods(), "", available);
  printTable("Display modes (--display)", displayModes(), "", available);
  printTable("Tone curves (tone, in the viewer)", toneCurves(), "", available);
  printTable("Exporters", exporters(), "--", available);
  printTable("Scene checks (unshot check)", sceneChecks(), "", available);
  printTable("What the plan may leave out (--do)", planRows(), "", available);
  std::vector<gl::Provider> providers(gl::providers().begin(), gl::providers().end());
  providers.push_back(glfwProvider());
  printTable("OpenGL providers (--gl)", std::span<const gl::Provider>(providers), "",
             [](const gl::Provider& p) {
               const std::string reason = p.unavailable();
               return reason.empty() || p.packages.empty()
                          ? reason
                          : reason + " (Debian: apt install " + std::string(p.packages) + ")";
             });
  printActions();
  std::cout << "Where a key is not given, or is auto, the program chooses and says what it chose.\n";
  return kExitDone;
}

}  // namespace

void setUpList(Command& command) { command.run = runList; }

}  // namespace unshot

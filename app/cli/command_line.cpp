#include "cli/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <memory>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/parse.h"
#include "cli/commands.h"
#include "exit_codes.h"

namespace unshot {
namespace {

struct CommandRow {
  std::string_view name;
  std::string_view description;
  void (*set_up)(Command& command);
};

constexpr std::array<CommandRow, 7> kCommands = {
    {{"view", "Open the viewer on a scene (also without saying view)", setUpView},
     {"solve", "Solve a scene without a window and write pictures, solutions, reports", setUpSolve},
     {"report", "Measure how the error falls with time and rows, mode by mode: tables, plots, a page",
      setUpReport},
     {"check", "Say what is in a scene, what is wrong with it and what it does not need", setUpCheck},
     {"compare", "Compare two pictures (PNG, HDR), solutions (PLY) or tables of probes (CSV)", setUpCompare},
     {"list", "List every mode, method, display, exporter and provider, and what works here", setUpList},
     {"selftest", "Solve scenes whose answer is known exactly, and say how far off each is here",
      setUpSelftest}}};

constexpr const char* kFooter =
    "unshot COMMAND --help says more. Without a command, the viewer opens.\n"
    "\n"
    "Exit codes: 0 done, 1 internal error, 2 usage, 3 input, 4 environment, 5 not converged\n"
    "within the limits given, 6 comparison failed, 130 interrupted. After 5 and 130 what\n"
    "was reached is written all the same.";

std::string commandNames() {
  std::string names;
  for (const CommandRow& command : kCommands)
    names += (names.empty() ? "" : ", ") + std::string(command.name);
  return names;
}

/// CLI11's help with our words.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() {
    column_width(26);
    label("Positionals", "Arguments");
    label("OPTIONS", "options");
  }
  std::string make_usage(const CLI::App* app, std::string name) const override {
    if (app->get_parent()) return CLI::Formatter::make_usage(app, name);
    return "Usage: unshot [SCENE.obj]\n       unshot COMMAND [options]\n";
  }
  // What excludes what stands in the words on it.
  std::string make_option_opts(const CLI::Option* option) const override {
    return option->get_items_expected_max() == 0 ? "" : CLI::Formatter::make_option_opts(option);
  }
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    return CLI::detail::find_and_replace(CLI::Formatter::make_help(app, name, mode), "\n\n\n", "\n\n");
  }
};

/// The arguments without the program's name, with `view` put first where no command is named.
std::vector<std::string> argumentsOf(int argc, const char* const* argv) {
  std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  if (arguments.empty()) return {"view"};
  const std::string& first = arguments.front();
  const bool about_program = first == "--help" || first == "-h" || first == "--version";
  if (about_program || isCommand(first)) return arguments;
  const bool names_file = first.find_first_of("./\\") != std::string::npos || std::filesystem::exists(first);
  if (!names_file && !first.starts_with('-')) {
    throw Error(ErrorKind::kUsage, "there is no command '" + first + "'", {}, "one of: " + commandNames());
  }
  arguments.insert(arguments.begin(), "view");
  return arguments;
}

/// "unshot solve --help lists the options", for the command that was being parsed.
std::string adviceOf(const std::vector<std::string>& arguments) {
  const std::string command =
      arguments.front() == "view" || !isCommand(arguments.front()) ? "" : " " + arguments.front();
  return "unshot" + command + " --help lists the options";
}

/// CLI11's message in our words.
std::string messageOf(const CLI::ParseError& error) {
  const std::string text = error.what();
  const std::string name = text.substr(0, text.find(':'));
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
    const std::string extra = text.substr(text.rfind(": ") + 2);
    // An unknown option leaves its value behind as well; the option is what to name.
    for (const std::string_view word : splitParts(extra, ' ')) {
      if (word.starts_with('-')) return "there is no option '" + std::string(word) + "'";
    }
    return "'" + extra.substr(0, extra.find(' ')) + "' is one argument too many";
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) {
    return text.find("At Most") != std::string::npos ? name + " may be given only once"
                                                     : name + " needs a value";
  }
  if (dynamic_cast<const CLI::RequiredError*>(&error))
    return text.substr(0, text.find(" is required")) + " is missing";
  if (dynamic_cast<const CLI::RequiresError*>(&error)) {
    const std::size_t middle = text.find(" requires ");
    return text.substr(0, middle) + " needs " + text.substr(middle + 10) + " beside it";
  }
  if (dynamic_cast<const CLI::ExcludesError*>(&error)) {
    const std::size_t middle = text.find(" excludes ");
    return text.substr(0, middle) + " and " + text.substr(middle + 10) + " cannot be given together";
  }
  return text;
}

}  // namespace

bool isCommand(std::string_view word) {
  return std::any_of(kCommands.begin(), kCommands.end(), [&](const CommandRow& c) { return c.name == word; });
}

int runCommandLine(int argc, const char* const* argv) {
  std::vector<std::string> arguments = argumentsOf(argc, argv);
  CLI::App app("Unshot: radiosity of OBJ scenes, with a measure of how wrong the picture still is.",
               "unshot");
  app.set_version_flag("--version", std::string("unshot ") + UNSHOT_VERSION, "Print the version and end");
  app.set_help_flag("-h,--help", "Print this help and end");
  app.formatter(std::make_shared<HelpFormatter>());
  app.footer(kFooter);
  app.require_subcommand(1);
  std::vector<std::pair<CLI::App*, std::unique_ptr<Command>>> commands;
  for (const CommandRow& row : kCommands) {
    CLI::App* parser =
        app.add_subcommand(std::string(row.name), std::string(row.description))->group("Commands");
    commands.emplace_back(parser, std::make_unique<Command>(*parser));
    row.set_up(*commands.back().second);
  }
  try {
    // CLI11 takes the arguments from the end.
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
    app.parse(reversed);
  } catch (const CLI::Success& asked_for_text) {
    return app.exit(asked_for_text, std::cout, std::cout);
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorKind::kUsage, messageOf(error), {}, adviceOf(arguments));
  }
  const auto chosen =
      std::find_if(commands.begin(), commands.end(), [](const auto& c) { return c.first->parsed(); });
  const int code = chosen->second->run();
  std::cout.flush();
  if (!std::cout)
    throw Error(ErrorKind::kEnvironment, "standard output cannot be written", {}, "check where it leads");
  return code;
}

}  // namespace unshot

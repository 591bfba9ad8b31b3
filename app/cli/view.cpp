#include <memory>
#include <string>

#include "base/error.h"
#include "cli/commands.h"

namespace unshot {

void addViewCommand(CLI::App& app, Run& run) {
  auto scene = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("view", "Open the viewer (not part of this version yet)");
  command->add_option("scene", *scene, "The scene")->type_name("")->option_text("[SCENE.obj]");
  command->callback([scene, &run] {
    run = [scene]() -> int {
      throw Error(
          ErrorKind::kEnvironment, "this version has no viewer", {},
          "unshot solve " + (scene->empty() ? std::string("SCENE.obj") : *scene) + " --png picture.png");
    };
  });
}

}  // namespace unshot

#include <memory>
#include <string>

#include "base/error.h"
#include "cli/commands.h"

namespace unshot {

void setUpView(Command& command) {
  auto scene = std::make_shared<std::string>();
  command.argument("SCENE.obj", *scene, "The scene", false);
  command.run = [scene]() -> int {
    throw Error(
        ErrorKind::kEnvironment, "this version has no viewer", {},
        "unshot solve " + (scene->empty() ? std::string("SCENE.obj") : *scene) + " --png picture.png");
  };
}

}  // namespace unshot

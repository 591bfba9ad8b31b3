#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <string>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/parse.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/saving_arguments.h"
#include "cli/solver_arguments.h"
#include "render/display_modes.h"
#include "render/picture.h"
#include "viewer/offscreen.h"
#include "viewer/window.h"

namespace unshot {
namespace {

class ViewArguments {
 public:
  explicit ViewArguments(Command& command) : solver_(command, SolverUse::kView) {
    command.argument("SCENE.obj", scene_,
                     "The scene: Wavefront OBJ with MTL (default: the bundled Cornell box)", false);
    command.group("The window");
    command.add("--script", script_, "F",
                "Perform the actions in this file, one a line (unshot list shows them)", fileName());
    command.add("--size", size_, "WxH", "Size of the window (default 1280x800)", sizeText(kLargestPicture));
    command.add("--display", display_, "MODE",
                "What is shown at first: " + keysOf(displayModes(), false) + " (default radiosity)",
                keyOf(displayModes(), false));
    command.add(
        "--memory", memory_, "DIR",
        "Remember cameras, scenes and the panel in this folder, with a script too; none: nowhere (default: "
        "$XDG_STATE_HOME/unshot or ~/.local/state/unshot, and with a script nowhere)",
        fileName());
    saving_.add(command, SolverUse::kView);
  }

  int run() const {
    const InterruptFlag interrupted;
    ViewerSetup setup;
    setup.interrupted = [&] { return interrupted.raised(); };
    setup.watch_interrupts = [](std::function<void()> wake) -> std::shared_ptr<void> {
      return std::make_shared<InterruptWatch>(std::move(wake));
    };
    const int code = show(std::move(setup));
    if (interrupted.raised()) std::cerr << "unshot: interrupted" << std::endl;
    return code;
  }

 private:
  int show(ViewerSetup setup) const {
    setup.scene = scene_.empty() ? std::filesystem::path(UNSHOT_ASSETS_DIR) / "cornell_box.obj"
                                 : std::filesystem::path(scene_);
    setup.bundled = bundledScenes();
    setup.options = solver_.options();
    setup.options.hemicube_drawing = HemicubeDrawing::kClassic;
    setup.settings.view.display = display_;
    if (!script_.empty()) {
      setup.script = readScript(script_);
      setup.script_name = script_;
    }
    if (!memory_.empty()) {
      setup.memory = memory_ == "none" ? "" : memory_;
    } else if (script_.empty()) {
      setup.memory = Memory::usualFolder();
    }
    setup.watch = script_.empty();
    useShaderDir(solver_.shaderDir());
    checkScene(setup.scene);
    checkSave(setup.scene);
    setup.session.kept = {saving_.save(), saving_.saveEvery(), setup.scene};
    checkResume();
    setup.resume = saving_.resume();
    setup.error_given = solver_.errorGiven();
    WindowOptions window;
    if (!size_.empty()) {
      const std::vector<std::string_view> parts = splitParts(size_, 'x');
      window = {static_cast<int>(*parseNumber(parts[0])), static_cast<int>(*parseNumber(parts[1])), true};
    }
    if (solver_.gl() == "auto" || solver_.gl() == "glfw") return runWindow(std::move(setup), window);
    if (script_.empty()) {
      throw Error(
          ErrorKind::kUsage, "--gl " + solver_.gl() + " opens no window, so the viewer needs a --script", {},
          "--script FILE, or no --gl, or: unshot solve " + setup.scene.string() + " --png picture.png");
    }
    return runOffscreen(std::move(setup), solver_.gl(), window.width, window.height);
  }

  // What need not wait for a window: a name with nothing behind it.
  static void checkScene(const std::filesystem::path& scene) {
    std::error_code error;
    if (std::filesystem::exists(scene, error)) return;
    throw Error(ErrorKind::kInput, "there is no such file", scene.string(), "the path of an OBJ file");
  }
  void checkResume() const {
    std::error_code error;
    if (saving_.resume().empty() || std::filesystem::exists(saving_.resume(), error)) return;
    throw Error(ErrorKind::kInput, "there is no such file", saving_.resume(), "a saved solve of unshot");
  }

  /// Whether the solve can be saved is found out before it begins.
  void checkSave(const std::filesystem::path& scene) const {
    if (saving_.save().empty()) return;
    if (samePath(saving_.save(), scene)) {
      throw Error(ErrorKind::kUsage, "--save would replace the input " + scene.string(), {},
                  "another file name");
    }
    checkWritable(saving_.save());
  }

  static std::vector<std::filesystem::path> bundledScenes() {
    std::vector<std::filesystem::path> scenes;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(UNSHOT_ASSETS_DIR, error)) {
      if (entry.path().extension() == ".obj") scenes.push_back(entry.path());
    }
    std::sort(scenes.begin(), scenes.end());
    return scenes;
  }

  SolverArguments solver_;
  SavingArguments saving_;
  std::string scene_, script_, size_, memory_, display_ = "radiosity";
};

}  // namespace

void setUpView(Command& command) {
  command.footer(
      "H in the window shows keys and mouse. A script has one action a line, # comments, and\n"
      "wait converged, wait shots N, wait seconds S (any wait also ends where the solve has ended\n"
      "or is paused). With --gl osmesa or egl a script runs without a window.\n"
      "\n"
      "Example: unshot view scene.obj --elements 30000");
  auto arguments = std::make_shared<ViewArguments>(command);
  command.run = [arguments] { return arguments->run(); };
}

}  // namespace unshot

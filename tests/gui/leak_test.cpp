// A window that is used for long: scenes, races, hemicubes and pictures that come and go leave nothing
// behind.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <fstream>

#include "export/image_files.h"
#include "support/live_viewer.h"
#include "support/temp_folder.h"
#include "viewer/teaching.h"

namespace unshot {
namespace {

using testing_support::LiveViewer;
using testing_support::TempFolder;

const std::string kScenes = std::string(UNSHOT_SOURCE_DIR) + "/assets/";

/// Objects of a kind that live, over all contexts of a provider whose functions it stands in the place of.
template <auto kMake, auto kDelete>
struct Counter {
  using Make = std::remove_reference_t<decltype(std::declval<gl::Functions&>().*kMake)>;
  using Delete = std::remove_reference_t<decltype(std::declval<gl::Functions&>().*kDelete)>;
  static inline std::atomic<int> living{0};
  static inline Make make = nullptr;
  static inline Delete destroy = nullptr;

  static void standIn(const gl::Functions& functions) {
    auto& fn = const_cast<gl::Functions&>(functions);
    make = fn.*kMake;
    destroy = fn.*kDelete;
    fn.*kMake = [](GLsizei count, GLuint* names) {
      make(count, names);
      living += count;
    };
    fn.*kDelete = [](GLsizei count, const GLuint* names) {
      destroy(count, names);
      living -= count;
    };
  }
};

using Buffers = Counter<&gl::Functions::GenBuffers, &gl::Functions::DeleteBuffers>;
using Textures = Counter<&gl::Functions::GenTextures, &gl::Functions::DeleteTextures>;
using Framebuffers = Counter<&gl::Functions::GenFramebuffers, &gl::Functions::DeleteFramebuffers>;
using Renderbuffers = Counter<&gl::Functions::GenRenderbuffers, &gl::Functions::DeleteRenderbuffers>;
using VertexArrays = Counter<&gl::Functions::GenVertexArrays, &gl::Functions::DeleteVertexArrays>;
using Queries = Counter<&gl::Functions::GenQueries, &gl::Functions::DeleteQueries>;

void standIn(const gl::Functions& fn) {
  Buffers::standIn(fn);
  Textures::standIn(fn);
  Framebuffers::standIn(fn);
  Renderbuffers::standIn(fn);
  VertexArrays::standIn(fn);
  Queries::standIn(fn);
}

std::vector<int> living() {
  return {Buffers::living,       Textures::living,     Framebuffers::living,
          Renderbuffers::living, VertexArrays::living, Queries::living};
}

double residentMegabytes() {
  std::ifstream statm("/proc/self/statm");
  double size = 0, resident = 0;
  statm >> size >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1e6;
}

class Use : public testing::Test {
 protected:
  Use() {
    writePng(folder_ / "picture.png", Image8{2, 1, {255, 128, 0, 0, 128, 255}});
    // Before either context has anything to do.
    const gl::Functions &window = live_.fn(), &solver = live_.solverFunctions();
    EXPECT_EQ(window.GenBuffers, solver.GenBuffers);
    EXPECT_EQ(window.DeleteQueries, solver.DeleteQueries);
    const gl::Functions before = window;
    standIn(window);
    const_cast<gl::Functions&>(solver) = window;
    EXPECT_NE(window.GenBuffers, before.GenBuffers);
  }
  static LiveViewer::Options options() {
    LiveViewer::Options options;
    options.solve.elements = 100;
    options.solve.error = 0.3;
    options.solve.form_factors = "hemicube";
    options.solve.hemicube_resolution = 32;
    options.width = 320;
    options.height = 240;
    return options;
  }
  void act(const std::string& action, const std::string& argument = {}) {
    live_->perform(action, argument);
    ASSERT_FALSE(live_->error()) << live_->error()->fullText();
  }
  void settle() {
    ASSERT_TRUE(live_.until([&] {
      const SessionPhase phase = live_->state().phase;
      return live_->upToDate() && phase != SessionPhase::kLoading && phase != SessionPhase::kRunning &&
             live_->scriptDone() && live_->nextFrame(0) > 1e30;
    }));
  }
  void open(const char* scene) {
    const std::uint64_t epoch = live_->state().epoch;
    act("open", kScenes + scene);
    ASSERT_TRUE(live_.until([&] { return live_->state().epoch > epoch; }));
    settle();
  }
  void once() {
    open("furnace.obj");
    act("race", "jacobi");
    ASSERT_TRUE(live_.until([&] { return live_->state().rival.has_value(); }));
    settle();
    act("race", "off");
    settle();
    act("pick", "0.5,0.4");
    settle();
    act("hemicube-view", "on");
    ASSERT_TRUE(live_.until([&] { return live_->teaching().settled() && live_->teaching().look(); }));
    settle();
    act("hemicube-view", "off");
    act("reference-picture", folder_ / "picture.png");
    settle();
    act("forget-picture");
    act("screenshot", folder_ / "window.png");
    settle();
    open("two_patches.obj");
  }

  TempFolder folder_;
  LiveViewer live_{options()};
};

TEST_F(Use, LeavesNoObjectsAndNoMemoryBehind) {
  // What is made when it is needed first stays.
  for (int k = 0; k < 3; ++k) {
    once();
    if (HasFatalFailure()) return;
  }
  const std::vector<int> objects = living();
  const double megabytes = residentMegabytes();
  for (int k = 0; k < 20; ++k) {
    once();
    if (HasFatalFailure()) return;
  }
  EXPECT_EQ(living(), objects) << "buffers, textures, framebuffers, renderbuffers, vertex arrays, queries";
  const double more = residentMegabytes() - megabytes;
  std::printf("[ MEASURED ] %.1f MB at first, %.1f MB more after 20 times\n", megabytes, more);
  EXPECT_LT(more, 0.1 * megabytes);
}

}  // namespace
}  // namespace unshot

// Pictures of the whole window, panels included, against those of pictures/.
//
// Times differ from run to run. Where a picture shows them it is masked: the reference is painted in one
// colour (kMask) there, and no pixel under it is compared. Drawing references again (UNSHOT_RENEW_PICTURES)
// runs the script several times and masks what differed, with room for longer figures.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "base/srgb.h"
#include "gui/support/panel.h"
#include "gui/support/program_pictures.h"

namespace unshot {
namespace {

namespace fs = std::filesystem;
using testing_support::kPanel;
using testing_support::ProgramResult;
using testing_support::runScript;
using testing_support::TempFolder;

const fs::path kReferences = fs::path(UNSHOT_SOURCE_DIR) / "tests/gui/pictures";
const fs::path kFailures = fs::path(UNSHOT_PROGRAM).parent_path() / "picture_failures";

struct WindowPicture {
  const char* name;
  int scale = 1;
};

constexpr std::array<WindowPicture, 5> kPictures = {
    {{"window"}, {"window_help"}, {"window_message"}, {"window_unshot"}, {"window_twice", 2}}};

// The curve against shots, not seconds, so that it is the same in each run.
constexpr const char* kScript =
    "plot shots\n"
    "wait converged\n"
    "screenshot window.png\n"
    "help on\n"
    "screenshot window_help.png\n"
    "help off\n"
    "open broken.obj\n"
    "wait seconds 0\n"
    "screenshot window_message.png\n"
    "dismiss\n"
    "display unshot\n"
    "screenshot window_unshot.png\n"
    "display radiosity\n"
    "scale 2\n"
    "size 2560x1440\n"
    "screenshot window_twice.png\n";

// The same renderer draws the same bytes: what is not masked differed in no pixel between eight runs, four of
// them with sanitizers and the machine busy. Another renderer may round single pixels of an edge or of a
// letter otherwise. A character of the panel has 25 pixels and more, so one that is missing, moved or another
// is noticed.
constexpr int kDifferent = 40;           // of 255, in one channel
constexpr double kMostInPanel = 20;      // pixels that may be different, at scale 1
constexpr double kMostInScene = 0.0005;  // of the scene's pixels; a line of text takes three times as many

constexpr std::array<float, 3> kMask{1, 0, 1};

bool masked(const ImageF& reference, std::size_t pixel) {
  return std::equal(kMask.begin(), kMask.end(), &reference.rgb[3 * pixel]);
}

bool different(const ImageF& a, const ImageF& b, std::size_t pixel) {
  for (std::size_t c = 3 * pixel; c < 3 * pixel + 3; ++c) {
    if (std::abs(srgb8FromLinear(a.rgb[c]) - srgb8FromLinear(b.rgb[c])) > kDifferent) return true;
  }
  return false;
}

Image8 toEightBits(const ImageF& image) {
  Image8 out{image.width, image.height, {}};
  for (const float v : image.rgb) out.rgb.push_back(srgb8FromLinear(v));
  return out;
}

/// Paints what differs between the pictures, and the room around it that a longer figure takes.
void mask(ImageF& reference, const std::vector<ImageF>& others, int scale) {
  const ImageF clean = reference;
  const int left = 110 * scale, right = 30 * scale, above = 5 * scale;
  for (int y = 0; y < clean.height; ++y) {
    for (int x = 0; x < clean.width; ++x) {
      const auto at = static_cast<std::size_t>(y * clean.width + x);
      const bool varies = std::any_of(others.begin(), others.end(), [&](const ImageF& other) {
        return !std::equal(&clean.rgb[3 * at], &clean.rgb[3 * at] + 3, &other.rgb[3 * at]);
      });
      if (!varies) continue;
      for (int v = std::max(y - above, 0); v <= std::min(y + above, clean.height - 1); ++v) {
        for (int u = std::max(x - left, 0); u <= std::min(x + right, clean.width - 1); ++u) {
          std::copy(kMask.begin(), kMask.end(),
                    &reference.rgb[3 * static_cast<std::size_t>(v * clean.width + u)]);
        }
      }
    }
  }
}

void runOnce(const TempFolder& folder) {
  folder.write("broken.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n");
  const std::string scene = std::string(UNSHOT_SOURCE_DIR) + "/assets/cornell_box.obj";
  const ProgramResult run = runScript(folder, kScript, {scene, "--elements", "1000", "--size", "1280x720"});
  ASSERT_EQ(run.code, 3) << run.err;  // of broken.obj
}

void renew() {
  std::array<TempFolder, 4> runs;
  for (const TempFolder& folder : runs) runOnce(folder);
  for (const WindowPicture& each : kPictures) {
    const std::string file = std::string(each.name) + ".png";
    std::vector<ImageF> others;
    for (const TempFolder& folder : runs) others.push_back(readImage(folder.path() / file));
    ImageF reference = others[0];
    mask(reference, others, each.scale);
    std::size_t count = 0, all = reference.rgb.size() / 3;
    for (std::size_t k = 0; k < all; ++k) count += masked(reference, k);
    EXPECT_LT(static_cast<double>(count), 0.025 * static_cast<double>(all))
        << each.name << ": too much varies";
    writePng(kReferences / file, toEightBits(reference));
    std::printf("%s: %zu of %zu pixels masked\n", each.name, count, all);
  }
}

struct Figures {
  std::size_t panel = 0, scene = 0;
};

/// Counts what is different, and paints it white in `difference`.
Figures compare(const ImageF& image, const ImageF& reference, int panel_left, ImageF& difference) {
  Figures figures;
  for (std::size_t k = 0; k < reference.rgb.size() / 3; ++k) {
    const bool wrong = !masked(reference, k) && different(image, reference, k);
    std::fill_n(&difference.rgb[3 * k], 3, wrong ? 1.0f : 0.0f);
    if (!wrong) continue;
    const int x = static_cast<int>(k % static_cast<std::size_t>(reference.width));
    ++(x >= panel_left ? figures.panel : figures.scene);
  }
  return figures;
}

void expectReference(const TempFolder& folder, const WindowPicture& each) {
  const std::string file = std::string(each.name) + ".png";
  const fs::path kept = kFailures / each.name;
  fs::remove_all(kept);
  const ImageF image = readImage(folder.path() / file), reference = readImage(kReferences / file);
  ASSERT_EQ(image.width, reference.width);
  ASSERT_EQ(image.height, reference.height);
  ImageF difference = reference;
  const int panel_left = image.width - kPanel * each.scale;
  const Figures found = compare(image, reference, panel_left, difference);
  const double scene_pixels = static_cast<double>(panel_left) * image.height;
  const double most_in_panel = kMostInPanel * each.scale * each.scale;
  const double most_in_scene = kMostInScene * scene_pixels;
  if (static_cast<double>(found.panel) <= most_in_panel && static_cast<double>(found.scene) <= most_in_scene)
    return;
  fs::create_directories(kept);
  fs::copy_file(folder.path() / file, kept / "picture.png");
  fs::copy_file(kReferences / file, kept / "reference.png");
  writePng(kept / "difference.png", toEightBits(difference));
  ADD_FAILURE() << each.name << ": different are " << found.panel << " pixels of the panel (at most "
                << most_in_panel << ") and " << found.scene << " of the scene (at most " << most_in_scene
                << ")\npicture.png, reference.png and difference.png: " << kept.string()
                << "\nmeant to change? tests/README.md says how to draw references again";
}

TEST(WindowPictures, AreTheReferences) {
  if (std::getenv("UNSHOT_RENEW_PICTURES")) {
    renew();
    GTEST_SKIP() << "renewed " << kReferences.string();
  }
  const TempFolder folder;
  ASSERT_NO_FATAL_FAILURE(runOnce(folder));
  for (const WindowPicture& each : kPictures) expectReference(folder, each);
}

}  // namespace
}  // namespace unshot

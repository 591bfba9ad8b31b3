// Timings: unshot_bench [--seconds T] [--quick] [--only TABLE]
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>

#include "bench/drawing_table.h"
#include "bench/estimate_table.h"
#include "bench/frame_table.h"
#include "bench/method_table.h"
#include "bench/picture_table.h"
#include "bench/plan_table.h"
#include "bench/reference_table.h"
#include "bench/scene_table.h"
#include "support/scenes.h"

namespace {

// Elements for about 10,000, 100,000 and 1,000,000 triangles, and 100,000 elements.
const std::vector<std::uint64_t> kFrameElements{4'700, 48'000, 100'000, 490'000};

void printPictures(bool quick) {
  if (quick) {
    unshot::bench::printPictureTable({300, 1000}, 3, 1);
  } else {
    unshot::bench::printPictureTable({1'000, 10'000, 100'000}, 200, 12);
  }
}

std::vector<std::filesystem::path> sceneFolders(bool quick) {
  std::vector<std::filesystem::path> folders{UNSHOT_SOURCE_DIR "/assets"};
  const char* scenes = std::getenv("UNSHOT_SCENES");
  if (scenes && !quick) folders.emplace_back(scenes);
  return folders;
}

void printDrawings(bool quick) {
  if (quick) {
    unshot::bench::printDrawingTable(sceneFolders(quick), 3, 100);
  } else {
    unshot::bench::printDrawingTable(sceneFolders(quick), 100, SIZE_MAX);
  }
}

void printPlans(bool quick, double seconds) {
  std::vector<std::filesystem::path> scenes;
  for (const char* name : {"furnace", "two_patches", "cornell_box", "two_rooms"})
    scenes.push_back(std::filesystem::path(UNSHOT_SOURCE_DIR "/assets") / (std::string(name) + ".obj"));
  const unshot::testing_support::TempFolder folder;
  scenes.insert(scenes.begin() + 2, unshot::testing_support::writeRoom(folder));
  for (const char* name :
       {"cornell_published/cornell_published.obj", "mcguire_cornell/CornellBox-Original.obj",
        "mcguire_cornell/CornellBox-Sphere.obj", "teapot_box/teapot_box.obj"}) {
    const char* others = std::getenv("UNSHOT_SCENES");
    if (others && std::filesystem::exists(std::filesystem::path(others) / name))
      scenes.push_back(std::filesystem::path(others) / name);
  }
  if (quick) scenes.resize(1);
  unshot::bench::printPlanTable(scenes, quick ? seconds : 6 * seconds);
}

void printFrames(bool quick) {
  if (quick) {
    unshot::bench::printFrameTable({2'000}, 0.2);
    unshot::bench::printOpeningTable({300});
  } else {
    unshot::bench::printFrameTable(kFrameElements, 2);
    unshot::bench::printOpeningTable({2'000, 10'000, 30'000});
  }
}

}  // namespace

int main(int argc, char** argv) {
  double seconds = 10;
  bool quick = false;
  std::string only;
  for (int k = 1; k < argc; ++k) {
    if (std::strcmp(argv[k], "--quick") == 0) {
      quick = true;
      seconds = 0.2;
    } else if (std::strcmp(argv[k], "--seconds") == 0 && k + 1 < argc) {
      seconds = std::atof(argv[++k]);
    } else if (std::strcmp(argv[k], "--only") == 0 && k + 1 < argc) {
      only = argv[++k];
    } else {
      std::fprintf(
          stderr,
          "usage: unshot_bench [--seconds T] [--quick] [--only TABLE]\n"
          "  --seconds T  time for each scene (default 10)\n"
          "  --quick      a short run that only shows that everything works\n"
          "  --only T     one table: pictures, drawings, methods, scenes, plan, frames, reference or "
          "estimates\n"
          "UNSHOT_SCENES names a folder of further scenes, with reference values in its folder truth.\n");
      return 2;
    }
  }
  try {
    const auto wanted = [&](const char* table) { return only.empty() || only == table; };
    if (wanted("pictures")) printPictures(quick);
    if (wanted("drawings")) printDrawings(quick);
    if (wanted("methods")) unshot::bench::printMethodTable(quick);
    if (wanted("scenes")) unshot::bench::printSceneTable(sceneFolders(quick), seconds);
    if (wanted("plan")) printPlans(quick, seconds);
    if (wanted("frames")) printFrames(quick);
    if (wanted("estimates")) unshot::bench::printEstimateTable(quick);
    if (wanted("reference")) unshot::bench::printReferenceTable(quick ? 8 : 256, quick ? 0.3 : 0.01);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "unshot_bench: %s\n", error.what());
    return 1;
  }
}

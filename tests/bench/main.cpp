// Timings: unshot_bench [--seconds T] [--quick]
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "bench/picture_table.h"
#include "bench/scene_table.h"

int main(int argc, char** argv) {
  double seconds = 10;
  bool quick = false;
  for (int k = 1; k < argc; ++k) {
    if (std::strcmp(argv[k], "--quick") == 0) {
      quick = true;
      seconds = 0.2;
    } else if (std::strcmp(argv[k], "--seconds") == 0 && k + 1 < argc) {
      seconds = std::atof(argv[++k]);
    } else {
      std::fprintf(
          stderr,
          "usage: unshot_bench [--seconds T] [--quick]\n"
          "  --seconds T  time for each scene (default 10)\n"
          "  --quick      a short run that only shows that everything works\n"
          "UNSHOT_SCENES names a folder of further scenes, with reference values in its folder truth.\n");
      return 2;
    }
  }
  try {
    if (quick) {
      unshot::bench::printPictureTable({300, 1000}, 3, 1);
    } else {
      unshot::bench::printPictureTable({1'000, 10'000, 100'000}, 200, 12);
    }
    std::vector<std::filesystem::path> folders{UNSHOT_SOURCE_DIR "/assets"};
    const char* scenes = std::getenv("UNSHOT_SCENES");
    if (scenes && !quick) folders.emplace_back(scenes);
    unshot::bench::printSceneTable(folders, seconds);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "unshot_bench: %s\n", error.what());
    return 1;
  }
}

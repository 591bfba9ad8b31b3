#include "bench/drawing_table.h"

#include <algorithm>
#include <string>

#include "bench/text_table.h"
#include "scene/obj_reader.h"
#include "support/hemicube_cost.h"

namespace unshot::bench {
namespace {

namespace fs = std::filesystem;
using testing_support::Dice;
using testing_support::HemicubeCost;

std::vector<fs::path> scenesOf(const std::vector<fs::path>& folders) {
  std::vector<fs::path> out;
  for (const fs::path& folder : folders) {
    if (!fs::is_directory(folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.is_regular_file() && entry.path().extension() == ".obj") out.push_back(entry.path());
    }
  }
  return out;
}

struct Figures {
  std::string name;
  std::size_t triangles = 0;
  double drawn = 0, drawn_wall = 0, traced = 0, traced_wall = 0;  // a hemicube [s]
};

Figures measure(const fs::path& path, const Scene& scene, gl::Context& context, int patches) {
  HemicubeCost drawn(scene, 0, context, HemicubeDrawing::kOpenGl);
  HemicubeCost traced(scene, 0, context, HemicubeDrawing::kRays);
  Dice dice(1);
  for (int k = 0; k < patches; ++k) {  // in turns, so that what else the machine does falls on both
    const std::uint32_t patch = drawn.somePatch(dice);
    drawn.measureOnce(patch, true);
    traced.measureOnce(patch, true);
  }
  return {path.stem().string(), drawn.mesh().triangles.size(),
          drawn.median(),       drawn.medianWall(),
          traced.median(),      traced.medianWall()};
}

}  // namespace

void printDrawingTable(const std::vector<fs::path>& folders, int patches, std::size_t most) {
  const std::unique_ptr<gl::Context> context = gl::createContext("auto");
  context->makeCurrent();
  std::printf("A hemicube of 64 pixels, drawn by %s or traced with rays\n", context->info().renderer.c_str());
  std::printf("(ms, drawn or traced, and counted; median of %d patches that do not shine.)\n\n", patches);
  std::vector<Figures> all;
  for (const fs::path& path : scenesOf(folders)) {
    const Scene scene = readObj(path);
    if (scene.polygons.size() <= most) all.push_back(measure(path, scene, *context, patches));
  }
  std::sort(all.begin(), all.end(),
            [](const Figures& a, const Figures& b) { return a.triangles < b.triangles; });
  TextTable table({"scene", "triangles", "OpenGL wall", "CPU", "rays wall", "CPU", "OpenGL/rays wall"});
  for (const Figures& f : all) {
    table.add({f.name, std::to_string(f.triangles), figure("%.2f", 1e3 * f.drawn_wall),
               figure("%.2f", 1e3 * f.drawn), figure("%.2f", 1e3 * f.traced_wall),
               figure("%.2f", 1e3 * f.traced), figure("%.1f", f.drawn_wall / f.traced_wall)});
  }
  table.print();
}

}  // namespace unshot::bench

#include "bench/picture_table.h"

#include <cmath>
#include <memory>

#include "bench/text_table.h"
#include "formfactor/hemicube_picture.h"
#include "formfactor/regions.h"
#include "gl/context.h"
#include "mesh/grid.h"
#include "scene/obj_reader.h"
#include "support/hemicube_cost.h"
#include "support/test_scenes.h"

namespace unshot::bench {
namespace {

using testing_support::Dice;
using testing_support::HemicubeCost;

// A column by brute force: a 512-pixel picture from each of about 64 parts of the patch, each pixel asked for
// its element.
std::vector<double> denseColumn(const Mesh& mesh, HemicubePicture& picture, std::uint32_t patch, Dice& dice) {
  const Side& side = mesh.sides[mesh.patch_side[patch]];
  const Surface& surface = mesh.surfaces[side.surface];
  std::vector<Region> parts{regionOfPatch(mesh, patch)};
  const double area = parts[0].area;
  while (parts.size() < 64) {
    std::vector<Region> finer;
    for (const Region& part : parts) {
      for (const Region& child : partsOf(mesh, part)) finer.push_back(child);
    }
    parts.swap(finer);
  }
  const HemicubeLayout layout{512};
  const std::vector<double> delta = deltaFormFactors(layout);
  std::vector<double> k(mesh.element_count, 0.0);
  for (const Region& part : parts) {
    const double turn = dice.between(0, 1.6);
    HemicubeFrame frame;
    frame.eye = surface.point(part.sample);
    frame.normal = side.normal;
    frame.right = std::cos(turn) * surface.axis_u + std::sin(turn) * surface.axis_v;
    frame.own_surface = side.surface;
    frame.near_distance = 1e-3 * std::sqrt(part.area);
    const HemicubeView::Result seen = picture.look(frame, layout);
    for (std::size_t p = 0; p < delta.size(); ++p) {
      const Item item = seen.items[p];
      if (item.nothing()) continue;
      const Surface& other = mesh.surfaces[item.surface()];
      const std::uint32_t other_side = other.side[item.back()];
      if (other_side == kNone) continue;
      const glm::dvec2 uv =
          other.extent / 65536.0 * glm::dvec2((item.chart & 0xffffu) + 0.5, (item.chart >> 16) + 0.5);
      const std::uint32_t local = elementAt(mesh, other, uv);
      if (local != kNone) k[mesh.sides[other_side].first_element + local] += part.area / area * delta[p];
    }
  }
  for (std::uint32_t e = 0; e < mesh.element_count; ++e)
    k[e] *= mesh.patch_area[patch] / mesh.element_area[e];
  return k;
}

struct ColumnFigures {
  double error = 0, seconds = 0, pictures = 0;
};

ColumnFigures measureColumns(HemicubeCost& cost, HemicubePicture& picture, int columns) {
  const Mesh& mesh = cost.mesh();
  Dice dice(1);
  double difference = 0, total = 0;
  ColumnFigures out;
  for (int n = 0; n < columns; ++n) {
    const std::uint32_t q = dice.below(mesh.patch_count);
    const std::uint64_t drawn = cost.method().drawn();
    const double start = cpuSeconds();
    const Column column = cost.method().column(q);
    out.seconds += (cpuSeconds() - start) / columns;
    out.pictures += static_cast<double>(cost.method().drawn() - drawn) / columns;
    std::vector<double> k(mesh.element_count, 0.0);
    column.forEach([&](std::uint32_t e, double value) { k[e] = value; });
    const std::vector<double> dense = denseColumn(mesh, picture, q, dice);
    double own_difference = 0, own_total = 0;
    for (std::uint32_t e = 0; e < mesh.element_count; ++e) {
      own_difference += mesh.element_area[e] * (k[e] - dense[e]) * (k[e] - dense[e]);
      own_total += mesh.element_area[e] * dense[e] * dense[e];
    }
    if (own_total <= 0) continue;
    difference += own_difference / own_total;
    total += 1;
  }
  out.error = total > 0 ? std::sqrt(difference / total) : 0;
  return out;
}

}  // namespace

void printPictureTable(const std::vector<std::uint64_t>& elements, int pictures, int columns) {
  const std::unique_ptr<gl::Context> context = gl::createContext("auto");
  context->makeCurrent();
  std::printf("Hemicubes of the Cornell box, drawn by %s\n", context->info().renderer.c_str());
  std::printf("(CPU time of all threads; a picture is drawn, read back and counted; median of %d columns.\n",
              pictures);
  std::printf(
      " Column error: RMS over %d patches of the relative L2 distance to 64 or more pictures of 512 "
      "pixels.)\n\n",
      columns);
  const Scene scene = testing_support::publishedCornellBox();
  std::vector<HemicubeCost> costs;
  for (const std::uint64_t count : elements) costs.emplace_back(scene, count, *context);
  Dice dice(2);
  for (int k = 0; k < pictures; ++k) {
    for (HemicubeCost& cost : costs) cost.measureOnce(dice);
  }
  TextTable table(
      {"elements", "patches", "picture ms", "to first", "pictures/column", "column ms", "column error"});
  for (HemicubeCost& cost : costs) {
    HemicubePicture picture(*context, cost.mesh());
    const ColumnFigures column = measureColumns(cost, picture, columns);
    table.add({std::to_string(cost.mesh().element_count), std::to_string(cost.mesh().patch_count),
               figure("%.2f", 1e3 * cost.median()), figure("%.2f", cost.median() / costs[0].median()),
               figure("%.1f", column.pictures), figure("%.1f", 1e3 * column.seconds),
               figure("%.1f %%", 100 * column.error)});
  }
  table.print();
}

}  // namespace unshot::bench

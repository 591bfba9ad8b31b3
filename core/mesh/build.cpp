#include "mesh/build.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/clock.h"
#include "base/error.h"
#include "base/text.h"
#include "mesh/display.h"
#include "mesh/grid.h"
#include "mesh/kept_sides.h"
#include "mesh/lit.h"
#include "mesh/near_emitters.h"
#include "mesh/numbering.h"
#include "mesh/patch_parts.h"
#include "mesh/weld.h"

namespace unshot {
namespace {

constexpr double kSmallestScene = 1e-30, kLargestScene = 1e30;  // [m]

// Patches are squares of so many cells that there are about a thousand of them: each then is a tenth of a
// room or less, below which smaller sources bring no accuracy, while a pass over all of them stays short.
std::uint32_t patchCells(double elements) {
  std::uint32_t cells = 1;
  while (cells < 8 && elements / (cells * cells) > 1000) cells *= 2;
  return cells;
}

void makeSides(const MeshOptions& options, const KeptSides& kept, Mesh& mesh) {
  for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s) {
    Surface& surface = mesh.surfaces[s];
    const Material& material = mesh.materials[surface.material];
    for (int back = 0; back < 2; ++back) {
      const std::uint32_t k = 2 * s + static_cast<std::uint32_t>(back);
      if (!kept.keep[k]) continue;
      Side side;
      side.surface = s;
      side.back = back;
      side.normal = back ? -surface.normal : surface.normal;
      side.room = kept.rooms[k];
      side.reflectance = material.reflectance;
      if (!back || !options.emit_front_only) side.emission = material.emission;
      surface.side[back] = static_cast<std::uint32_t>(mesh.sides.size());
      mesh.sides.push_back(side);
      mesh.lit_area += surface.area;
    }
  }
}

int litSides(const Surface& s) { return (s.side[0] != kNone) + (s.side[1] != kNone); }

// Where `paired`, an even number as soon as it is more than one.
std::uint32_t cellsAlong(double extent, double size, bool paired) {
  const double n = std::round(extent / size);
  if (n < 1) return 1;
  if (n > 1e6) return 1'000'000;
  return paired && n > 1 ? 2 * static_cast<std::uint32_t>(std::round(extent / size / 2))
                         : static_cast<std::uint32_t>(n);
}

// Where paired: of a surface that reflects nothing, on which light need not be known; what it may emit is
// even.
constexpr std::uint32_t kMostBlackCells = 16;

// A thin frame or a long sliver leaves most cells of its chart empty. Grids beyond the first number hold at
// most so many cells for each that is not.
constexpr double kFewCells = 20'000, kMostEmpty = 100;

glm::uvec2 cellsOf(const Mesh& mesh, const Surface& s, double size, bool paired) {
  glm::uvec2 cells(cellsAlong(s.extent.x, size, paired), cellsAlong(s.extent.y, size, paired));
  const double all = static_cast<double>(cells.x) * cells.y;
  const double most = std::max(kFewCells, kMostEmpty * all * s.area / (s.extent.x * s.extent.y));
  if (all > most) {
    const double coarser = size * std::sqrt(all / most);
    cells = {cellsAlong(s.extent.x, coarser, paired), cellsAlong(s.extent.y, coarser, paired)};
    cells = glm::min(cells, glm::uvec2(static_cast<std::uint32_t>(kFewCells)));
  }
  const bool black = mesh.materials[s.material].reflectance == glm::dvec3(0.0);
  return paired && black ? glm::min(cells, glm::uvec2(kMostBlackCells)) : cells;
}

double elementsOf(const Mesh& mesh, const Surface& s, double size, bool paired) {
  if (!isLit(s)) return 0;
  const glm::dvec2 cells(cellsOf(mesh, s, size, paired));
  return litSides(s) * std::max(1.0, cells.x * cells.y * s.area / (s.extent.x * s.extent.y));
}

// Where paired: rectangles that emit and are hardly larger than one of so many elements of the whole scene
// are one patch. What emits is known exactly wherever it arrives, and each patch of it takes rays of its own.
// Lamps of other outlines would be many polygons, whose shadows' edges nobody looks for.
constexpr double kSmallLamps = 160;
constexpr double kHardlyLarger = 1.5;    // along each side
constexpr double kRectangle = 1 - 1e-9;  // of the chart's area

bool isSmallLamp(const Mesh& mesh, const Surface& s) {
  const double longest = kHardlyLarger * std::sqrt(mesh.lit_area / kSmallLamps);
  return mesh.materials[s.material].emission != glm::dvec3(0.0) &&
         std::max(s.extent.x, s.extent.y) <= longest && s.area >= kRectangle * s.extent.x * s.extent.y;
}

void gridAll(Mesh& mesh, const std::vector<double>& sizes, bool paired, const Contacts& contacts,
             double tolerance, const CancelToken& cancel) {
  mesh.cells.clear();
  mesh.pieces.clear();
  mesh.piece_corners.clear();
  mesh.nodes.clear();
  mesh.patch_shapes.clear();
  mesh.shapes.clear();
  double elements = 0;
  for (std::size_t s = 0; s < sizes.size(); ++s)
    elements += elementsOf(mesh, mesh.surfaces[s], sizes[s], paired);
  if (elements > static_cast<double>(kMostElements)) {
    throw Error(ErrorKind::kUsage,
                "the mesh would have about " + std::to_string(static_cast<std::uint64_t>(elements)) +
                    " elements; the most is " + std::to_string(kMostElements),
                {}, "a larger --element-size, or --elements");
  }
  const std::uint32_t patch_cells = paired ? 2 : patchCells(elements);
  mesh.patch_size = patch_cells * *std::max_element(sizes.begin(), sizes.end());
  for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s) {
    Surface& surface = mesh.surfaces[s];
    cancel.check();
    cancel.report(static_cast<double>(s) / static_cast<double>(mesh.surfaces.size()));
    if (!isLit(surface)) continue;
    const glm::uvec2 cells = cellsOf(mesh, surface, sizes[s], paired);
    const std::uint32_t own_cells =
        paired && isSmallLamp(mesh, surface) ? std::max({cells.x, cells.y, patch_cells}) : patch_cells;
    gridSurface(mesh, s, cells.x, cells.y, own_cells, paired, contacts[s], tolerance, cancel);
  }
}

double countElements(const Mesh& mesh) {
  double count = 0;
  for (const Surface& s : mesh.surfaces) count += static_cast<double>(litSides(s)) * s.elements.count;
  return count;
}

// Sizes per surface whose estimated count is nearest to `wanted`: one size for all, but for the few surfaces
// that tip from one whole number of cells to the next just there.
std::vector<double> sizesFor(const Mesh& mesh, double wanted, bool paired, const CancelToken& cancel) {
  const auto estimate = [&](double size) {
    cancel.check();
    double sum = 0;
    for (const Surface& s : mesh.surfaces) sum += elementsOf(mesh, s, size, paired);
    return sum;
  };
  double coarse = 2 * glm::length(mesh.bounds_max - mesh.bounds_min), fine = coarse;
  while (estimate(fine) < wanted && fine > coarse * 1e-7) fine /= 2;
  for (int k = 0; k < 60; ++k) {
    const double middle = std::sqrt(coarse * fine);
    (estimate(middle) < wanted ? coarse : fine) = middle;
  }
  std::vector<double> sizes(mesh.surfaces.size(), coarse);
  double sum = estimate(coarse);
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    const double step =
        elementsOf(mesh, mesh.surfaces[s], fine, paired) - elementsOf(mesh, mesh.surfaces[s], coarse, paired);
    if (std::abs(sum + step - wanted) > std::abs(sum - wanted)) continue;
    sizes[s] = fine;
    sum += step;
  }
  return sizes;
}

void sayCount(Mesh& mesh, double wanted) {
  mesh.diagnostics.push_back(
      {Severity::kNote,
       "element-count",
       std::to_string(static_cast<std::uint64_t>(wanted)) + " elements were asked for, the mesh has " +
           std::to_string(static_cast<std::uint64_t>(countElements(mesh))) + ": each of the " +
           std::to_string(mesh.sides.size()) + " lit surface sides needs at least one",
       {},
       {}});
}

// The most elements that are asked for, over those that are wanted.
constexpr double kMostAsked = 10;

void gridForCount(Mesh& mesh, double wanted, bool paired, const Contacts& contacts, double tolerance,
                  const CancelToken& cancel) {
  double least = 0;
  for (const Surface& s : mesh.surfaces) least += litSides(s);
  const double by_area = wanted;
  if (paired) wanted += least;
  // More sides than elements asked for: large surfaces are still cut as finely as the number says by area.
  if (least > 0.9 * wanted) {
    gridAll(mesh, std::vector<double>(mesh.surfaces.size(), std::sqrt(mesh.lit_area / by_area)), paired,
            contacts, tolerance, cancel);
    sayCount(mesh, wanted);
    return;
  }
  double asked = wanted, best_error = INFINITY;
  std::vector<double> best;
  // Clipped and joined cells make the count differ from the estimate by some percent; a few corrections close
  // the gap.
  for (int attempt = 0; attempt < 6; ++attempt) {
    const std::vector<double> sizes = sizesFor(mesh, asked, paired, cancel);
    gridAll(mesh, sizes, paired, contacts, tolerance, cancel);
    const double error = std::abs(countElements(mesh) / wanted - 1);
    if (error < best_error) {
      best_error = error;
      best = sizes;
    }
    // Where nothing was clipped or joined no other sizes are nearer.
    double expected = 0;
    for (std::size_t s = 0; s < sizes.size(); ++s)
      expected += elementsOf(mesh, mesh.surfaces[s], sizes[s], paired);
    if (error < 0.03 || (attempt == 0 && std::abs(countElements(mesh) - expected) < 0.5)) break;
    // Cells below the tolerance are joined however many are asked for.
    asked = std::min(asked * wanted / countElements(mesh), kMostAsked * wanted);
  }
  if (std::abs(countElements(mesh) / wanted - 1) > best_error)
    gridAll(mesh, best, paired, contacts, tolerance, cancel);
  if (best_error > 0.1) sayCount(mesh, wanted);
}

// Vertices, areas of elements and what is made of them are written in single precision, which ends near 1e38
// and 1e-38.
void sayExtremeSize(Mesh& mesh, const Scene& scene) {
  const double size = glm::length(mesh.bounds_max - mesh.bounds_min);
  if (size > kSmallestScene && size < kLargestScene) return;
  mesh.diagnostics.push_back(
      {Severity::kWarning, "extreme-size",
       "the scene measures " + figureText(size) +
           " m across, beyond what single precision holds: solution and files are not to "
           "be relied on",
       scene.path.string(), "another unit of length"});
}

void checkFineness(const MeshOptions& options) {
  if (options.elements && options.element_size) {
    throw Error(ErrorKind::kUsage, "--elements and --element-size exclude each other");
  }
  if ((options.elements && *options.elements == 0) ||
      (options.element_size && !(*options.element_size > 0 && std::isfinite(*options.element_size)))) {
    throw Error(ErrorKind::kUsage, "the number or the size of elements must be above zero");
  }
}

}  // namespace

SurfacesOfScene findSurfaces(const Scene& scene, const MeshOptions& options, const CancelToken& cancel) {
  SurfacesOfScene out;
  Mesh& mesh = out.mesh;
  mesh.frame_origin = scene.frame_origin;
  mesh.bounds_min = scene.bounds_min;
  mesh.bounds_max = scene.bounds_max;
  mesh.materials = scene.materials;
  // Shares of the time that a large scene takes.
  SurfaceTopology topology = makeSurfaces(scene, weld(scene, cancel.part(0, 0.2)), options.join_polygons,
                                          mesh, cancel.part(0.2, 0.35));
  mesh.smooth_pairs = std::move(topology.smooth_pairs);
  out.edges = std::move(topology.edges);
  if (mesh.surfaces.empty()) {
    throw Error(ErrorKind::kInput, "no face of the scene has any area", scene.path.string(),
                "unshot check on the scene");
  }
  sayExtremeSize(mesh, scene);
  mesh.weld_distance = weldDistance(scene);
  out.crossings = findCrossings(mesh, 2 * mesh.weld_distance, cancel.part(0.35, 0.45));
  const double plan_began = wallSeconds();
  mesh.all_tested = options.all_tested;
  makeSides(options, sidesToKeep(options, out.edges, out.crossings, mesh, cancel.part(0.45, 0.95)), mesh);
  out.plan_seconds = wallSeconds() - plan_began;
  putLitTrianglesFirst(mesh);
  findBetween(options.sky, mesh, cancel.part(0.95, 1));
  return out;
}

Mesh meshSurfaces(SurfacesOfScene surfaces, const MeshOptions& options, const CancelToken& cancel) {
  checkFineness(options);
  Mesh mesh = std::move(surfaces.mesh);
  const double tolerance = mesh.weld_distance;
  const double size = options.element_size.value_or(
      std::sqrt(mesh.lit_area / static_cast<double>(options.elements.value_or(kDefaultElements))));
  const Contacts contacts =
      findContacts(mesh, surfaces.edges, surfaces.crossings, 2 * tolerance, size, cancel.part(0, 0.1));
  if (options.elements) {
    gridForCount(mesh, static_cast<double>(*options.elements), options.paired_cells, contacts, tolerance,
                 cancel.part(0.1, 0.4));
  } else if (!mesh.sides.empty()) {
    std::vector<double> sizes(mesh.surfaces.size(), size);
    if (!options.element_size) refineNearEmitters(mesh, sizes, cancel);
    gridAll(mesh, sizes, options.paired_cells, contacts, tolerance, cancel.part(0.1, 0.4));
  }
  numberElements(mesh, cancel);
  makeDisplay(mesh, cancel.part(0.4, 1));
  joinSmallPatches(mesh, cancel);
  return mesh;
}

Mesh buildMesh(const Scene& scene, const MeshOptions& options, const CancelToken& cancel) {
  checkFineness(options);
  return meshSurfaces(findSurfaces(scene, options, cancel), options, cancel);
}

}  // namespace unshot

// Checks of a scene's shape: its scale, its edges, gaps between its surfaces.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>

#include "base/random.h"
#include "base/text.h"
#include "session/scene_checks.h"

namespace unshot {
namespace {

// [m] across. What is smaller or larger was hardly measured in metres.
constexpr double kSmall = 1e-3, kLarge = 1e5;
// Beyond what the mesh remarks on itself (extreme-size).
constexpr double kExtremelySmall = 1e-30, kExtremelyLarge = 1e30;
// Single precision has seven digits: further off than so many sizes of the scene, one or two are left for the
// scene itself.
constexpr double kFarOff = 1e5;

// Of the scene's size: gaps up to this are narrower than anything that was modelled to be seen.
constexpr double kGap = 2e-5;
constexpr std::uint32_t kGapPoints = 20'000, kMostPointsEach = 16;

std::string digitsLeft(double ratio) {
  const int left = std::max(0, static_cast<int>(std::floor(7 - std::log10(ratio))));
  return left == 0 ? "no digit" : countedText(static_cast<std::uint64_t>(left), "digit");
}

}  // namespace

Diagnostics checkScale(CheckedScene& checked) {
  Diagnostics out;
  const double size = checked.size();
  if (!(size > kExtremelySmall && size < kExtremelyLarge)) return out;
  const std::string place = checked.scene().path.string();
  if (size < kSmall || size > kLarge) {
    out.push_back({Severity::kWarning,
                   {},
                   "the scene measures " + figureText(size) +
                       " m across, which is odd for one in metres: light is the "
                       "same at any scale, but not --element-size, probe points and cameras",
                   place,
                   "export it in metres"});
  }
  const glm::dvec3 origin = glm::abs(checked.scene().frame_origin);
  const double away = std::max({origin.x, origin.y, origin.z});
  if (away > kFarOff * size) {
    out.push_back({Severity::kWarning,
                   {},
                   "the scene lies " + figureText(away / size) +
                       " times its own size from the origin: a file written in "
                       "single precision has " +
                       digitsLeft(away / size) + " left for its shape",
                   place,
                   "move the scene to the origin before it is exported"});
  }
  return out;
}

Diagnostics checkNearlyTouching(CheckedScene& checked) {
  const Mesh& mesh = checked.mesh();
  const auto count = static_cast<std::uint32_t>(mesh.surfaces.size());
  const std::uint32_t each = std::clamp(kGapPoints / std::max(count, 1u), 1u, kMostPointsEach);
  const std::uint32_t stride = 1 + count / kGapPoints;
  const double reach = kGap * checked.size(), contact = 2 * mesh.weld_distance;
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  double least = INFINITY;
  std::uint32_t first = kNone;
  for (std::uint32_t s = 0; s < count; s += stride) {
    checked.cancel().check();
    const Surface& surface = mesh.surfaces[s];
    if (surface.triangles.count == 0) continue;
    for (std::uint32_t k = 0; k < each; ++k) {
      const std::uint64_t seed = 4 * (std::uint64_t{s} * kMostPointsEach + k);
      const auto unit = [&](std::uint64_t n) { return unitInterval(mixBits(seed + n)); };
      const auto t = static_cast<std::uint32_t>(unit(0) * surface.triangles.count);
      const ChartTriangle& triangle = mesh.triangles[surface.triangles.first + t];
      const double root = std::sqrt(unit(1)), v = unit(2);
      const glm::dvec2 uv =
          (1 - root) * triangle.uv[0] + root * (1 - v) * triangle.uv[1] + root * v * triangle.uv[2];
      for (const ParallelSurfaces::Found& found : checked.parallels().around(surface.point(uv), s, reach)) {
        const double gap = std::abs(found.height);
        // Backs face to face are a thin board, with nothing in it that light could get to.
        if (gap <= contact || (found.height < 0 && !found.same_way)) continue;
        pairs.insert(std::minmax(s, found.surface));
        least = std::min(least, gap);
        first = std::min({first, surface.polygon, mesh.surfaces[found.surface].polygon});
      }
    }
  }
  if (pairs.empty()) return {};
  return {{Severity::kNote,
           {},
           countedText(pairs.size(), "pair") + " of parallel surfaces nearly touch, with gaps from " +
               figureText(least) + " m: light in them takes many elements and changes nothing that is seen",
           checked.placeOfPolygon(first),
           "make them touch, or move them apart by " + figureText(10 * reach) + " m or more"}};
}

Diagnostics checkWinding(CheckedScene& checked) {
  const Scene& scene = checked.scene();
  std::size_t turned = 0;
  std::uint32_t first = kNone;
  bool lights = false;
  forEachEdge(checked.edges(), [&](std::span<const PolygonEdge> uses) {
    if (uses.size() != 2 || uses[0].forward != uses[1].forward || uses[0].polygon == uses[1].polygon) return;
    const Polygon &a = scene.polygons[uses[0].polygon], &b = scene.polygons[uses[1].polygon];
    ++turned;
    first = std::min({first, uses[0].polygon, uses[1].polygon});
    lights = lights || (scene.materials[a.material].emits() && scene.materials[b.material].emits());
  });
  if (turned == 0) return {};
  const bool matters = lights && checked.emitFrontOnly();
  return {{matters ? Severity::kWarning : Severity::kNote,
           {},
           "across " + countedText(turned, "edge") +
               " neighbouring faces are wound the other way round, front beside " + "back" +
               (matters ? ", lights among them, of which only fronts emit" : ""),
           checked.placeOfPolygon(first),
           matters ? "make the normals consistent"
                   : "nothing has to be done: surfaces have two sides (with --emit front, make those of "
                     "lights consistent)"}};
}

Diagnostics checkClosed(CheckedScene& checked) {
  // Lone sheets, such as lamps, have no neighbour that could be missing.
  std::vector<bool> lone(checked.scene().polygons.size(), true);
  forEachEdge(checked.edges(), [&](std::span<const PolygonEdge> uses) {
    for (const PolygonEdge& use : uses) lone[use.polygon] = lone[use.polygon] && uses.size() == 1;
  });
  std::size_t open = 0;
  std::uint32_t first = kNone;
  forEachEdge(checked.edges(), [&](std::span<const PolygonEdge> uses) {
    if (uses.size() % 2 == 0 || lone[uses[0].polygon]) return;
    ++open;
    first = std::min(first, uses[0].polygon);
  });
  // Most often things without a bottom that stand on something: edges alone show nothing.
  const LightWalks& walks = checked.walks();
  if (walks.escapes == 0) return {};
  const std::string escape = walks.escaped ? percentText(*walks.escaped) + " of the light escapes"
                                           : percentText(static_cast<double>(walks.escapes) / walks.rays) +
                                                 " of the ways that light may take lead out";
  const std::string edges =
      open == 0 ? "" : " (" + countedText(open, "edge") + " without a neighbour, the first here)";
  return {{Severity::kNote,
           {},
           "the scene is open: about " + escape + edges,
           open == 0 ? checked.scene().path.string() : checked.placeOfPolygon(first),
           "close it where that is not meant: what escapes is gone"}};
}

Diagnostics checkSpectralRadius(CheckedScene& checked) {
  constexpr double kSlow = 0.99, kNever = 1 - 1e-6;
  const LightWalks& walks = checked.walks();
  const double radius = walks.largestRadius();
  if (radius < kSlow) return {};
  if (radius >= kNever) {
    return {{Severity::kWarning,
             {},
             "nothing absorbs light and none escapes: with a light in it there is no finite solution",
             checked.scene().path.string(),
             "lower the Kd of a material, or open the scene"}};
  }
  return {{Severity::kWarning,
           {},
           "each bounce keeps about " + percentText(radius) +
               " of the light (spectral radius): 1 % is left of it after " +
               countText(static_cast<std::uint64_t>(*walks.bouncesToOnePercent())) +
               " bounces, so a solve takes long",
           checked.scene().path.string(),
           "lower the Kd of the brightest materials; what is real stays below 0.9"}};
}

}  // namespace unshot

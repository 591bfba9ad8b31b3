// Manufactured scenes: B = b whatever the geometry (stability_scenes.h).
#include "stability/scene_through_obj.h"
#include "stability/stability_rows.h"
#include "stability/stability_scenes.h"

namespace unshot {
namespace {

struct Manufactured {
  const char* key;
  const char* title;
  Scene (*make)();
  std::uint64_t elements;
  const char* says = nullptr;  ///< a diagnostic that has to be there
  std::vector<KnownException> exceptions = {};
};

// Two blocks in one another leave elements that few pixels see; measured 4.4 to 5.1 % with them, 0.7 % with
// rays.
const KnownException kFewPixels = {"hemicube",
                                   "counted pixels leave 5 % of noise on elements that few of them see", 1.5};
constexpr const char* kEither =
    "of surfaces that overlap in one plane each pixel shows either, and the one that is hidden gets light "
    "too";

const std::vector<Manufactured>& manufacturedScenes() {
  static const std::vector<Manufactured> table = {
      {"blocks",
       "two blocks that pass through each other, in a box",
       interpenetratingBlocks,
       400,
       nullptr,
       {kFewPixels}},
      {"fins", "seven thin walls that share one edge, in a box", finsOnOneEdge, 400},
      {"door", "two rooms with a door between", twoRoomsWithADoor, 400},
      {"concave", "concave polygons: a floor, a plate, a block", concavePolygons, 500},
      {"slivers", "sixty strips of 1:10,000 across the floor", sliverStrips, 400},
      {"needles", "a floor of 200 triangles about one point", needleFan, 400},
      {"t-junctions", "chequers that meet at no corner along any edge", tJunctions, 400},
      {"windings", "faces wound either way", [] { return throughObj(wrongWindings()); }, 400},
      {"coplanar",
       "plates in the planes of ceiling and wall, a block on the floor",
       coplanarPlates,
       400,
       nullptr,
       {{"hemicube", kEither, 5}}},
      {"duplicates", "faces that are there twice and three times",
       [] { return throughObj(duplicatedFaces()); }, 400, "duplicate-face"},
      {"white-walls", "four walls of reflectance exactly 1", [] { return whiteWalls(1); }, 300},
      {"reflectance-1.5", "two walls of reflectance 1.5 in the file, which counts as 1",
       [] { return throughObj(reflectanceOutOfRange(1.5)); }, 300, "reflectance-clamped"},
      {"reflectance-negative", "two walls of reflectance -0.3 in the file, which counts as 0",
       [] { return throughObj(reflectanceOutOfRange(-0.3)); }, 300, "reflectance-clamped"},
  };
  return table;
}

// Whatever the geometry, so that the tolerance is that of sums over what a point sees.
constexpr double kMeanTolerance = 0.01, kRmsTolerance = 0.05;

std::vector<Figure> manufacturedFigures(const Solve& solve) {
  return evenFigures(solve, kManufactured, kMeanTolerance, kRmsTolerance);
}

}  // namespace

void addManufactured(Cases& cases) {
  for (const Manufactured& m : manufacturedScenes()) {
    cases.push_back({.key = m.key,
                     .title = m.title,
                     .expected = "B = 1, 2, 0.5 everywhere",
                     .make = m.make,
                     .options = evenMesh(m.elements, 1e-4),
                     .measure =
                         [says = m.says](const Solve& s) {
                           std::vector<Figure> out = manufacturedFigures(s);
                           if (says) out.push_back(saidFigure(s, says));
                           return out;
                         },
                     .exceptions = m.exceptions});
  }
  cases.push_back({.key = "many-quads",
                   .title = "a cube of 101,400 quads",
                   .expected = "B = 1, 2, 0.5 everywhere",
                   .make = manyQuads,
                   .options = evenMesh(96, 1e-4),
                   .measure = manufacturedFigures,
                   .large = true,
                   .most_seconds = 120});
}

namespace {

/// The scene elsewhere: position = scale * position + shift.
Scene placed(const Scene& scene, double scale, double shift) {
  SceneBuilder builder;
  for (const Material& m : scene.materials) builder.material(m.name, m.reflectance, m.emission);
  for (const Polygon& polygon : scene.polygons) {
    std::vector<glm::dvec3> corners;
    for (std::uint32_t k = 0; k < polygon.corner_count; ++k)
      corners.push_back(scale * (scene.frame_origin + scene.position(polygon, k)) +
                        glm::dvec3(shift, -shift, shift));
    builder.polygon(polygon.material, corners);
  }
  return builder.finish();
}

}  // namespace

void addPlaces(Cases& cases) {
  const struct {
    const char* key;
    const char* where;
    double scale, shift;
  } places[] = {{"small", "a thousandth as large", 1e-3, 0},
                {"big", "10,000 times as large", 1e4, 0},
                {"far", "moved by 1e5 along every axis", 1, 1e5}};
  for (const auto& p : places) {
    const double scale = p.scale, shift = p.shift;
    const std::string key = p.key, where = p.where;
    cases.push_back({.key = key + "-lit-face",
                     .title = "closed cube, reflectance 0.8, one face lit, " + where,
                     .expected = "the same B as at its own size and place",
                     .make = [=] { return placed(litCube(glm::dvec3(0.8), glm::dvec3(1.0)), scale, shift); },
                     .options = evenMesh(294, 1e-5),
                     .measure =
                         [t = &litCubeTruth(0.8)](const Solve& s) {
                           return litCubeFigures(s, {t, t, t}, glm::dvec3(1.0), 0.01);
                         }});
    cases.push_back({.key = key + "-blocks",
                     .title = "two blocks that pass through each other, in a box, " + where,
                     .expected = "B = 1, 2, 0.5 everywhere",
                     .make = [=] { return placed(interpenetratingBlocks(), scale, shift); },
                     .options = evenMesh(400, 1e-4),
                     .measure = manufacturedFigures,
                     .exceptions = {kFewPixels}});
  }
}

}  // namespace unshot

#include "export/probes.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "base/cancel.h"
#include "base/csv_table.h"
#include "base/error.h"
#include "rays/nearest_triangle.h"

namespace unshot {
namespace {

constexpr double kLeastCosine = 0.5;       // between the normals of probe and side
constexpr double kReachOfDiagonal = 2e-3;  // a face that is not planar may be split along another diagonal

/// The triangles that probes can lie on: the display triangles, and both sides of the scene's own where a
/// side is dark.
struct Target {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> corners;
  std::vector<glm::vec3> normals;  ///< one per triangle
  std::size_t displayed = 0;       ///< triangles below this number are display triangles

  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    corners.insert(corners.end(), {a, b, c});
    const glm::dvec3 origin(positions[a]);
    const glm::dvec3 normal =
        glm::cross(glm::dvec3(positions[b]) - origin, glm::dvec3(positions[c]) - origin);
    const double length = glm::length(normal);
    normals.emplace_back(length > 0 ? normal / length : glm::dvec3(0.0));
  }
};

/// What lies within `reach` of some probe, at least. Rounding is far below `reach`.
struct Box {
  glm::vec3 low{INFINITY}, high{-INFINITY};

  Box(std::span<const Probe> probes, const glm::dvec3& origin, double reach) {
    for (const Probe& probe : probes) {
      const glm::vec3 at(probe.position - origin);
      low = glm::min(low, at);
      high = glm::max(high, at);
    }
    low -= glm::vec3(2 * static_cast<float>(reach));
    high += glm::vec3(2 * static_cast<float>(reach));
  }
  bool meets(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) const {
    const glm::vec3 least = glm::min(a, glm::min(b, c)), most = glm::max(a, glm::max(b, c));
    return glm::all(glm::lessThanEqual(least, high)) && glm::all(glm::greaterThanEqual(most, low));
  }
};

void addDarkSides(const Mesh& mesh, const Box& box, Target& target) {
  for (const Surface& surface : mesh.surfaces) {
    for (int back = 0; back < 2; ++back) {
      if (surface.side[back] != kNone) continue;
      for (std::uint32_t t = surface.triangles.first; t < surface.triangles.end(); ++t) {
        glm::vec3 corner[3];
        for (int k = 0; k < 3; ++k) corner[k] = glm::vec3(surface.point(mesh.triangles[t].uv[k]));
        if (!box.meets(corner[0], corner[1], corner[2])) continue;
        const auto first = static_cast<std::uint32_t>(target.positions.size());
        target.positions.insert(target.positions.end(), corner, corner + 3);
        if (back) {
          target.add(first, first + 2, first + 1);
        } else {
          target.add(first, first + 1, first + 2);
        }
      }
    }
  }
}

// The triangles in the box.
Target targetOf(const Mesh& mesh, const Box& box) {
  Target target;
  target.positions.reserve(mesh.vertices.size());
  for (const Vertex& vertex : mesh.vertices) target.positions.push_back(vertex.position);
  for (std::size_t k = 0; k + 2 < mesh.triangle_vertices.size(); k += 3) {
    const std::uint32_t* corner = &mesh.triangle_vertices[k];
    if (box.meets(target.positions[corner[0]], target.positions[corner[1]], target.positions[corner[2]]))
      target.add(corner[0], corner[1], corner[2]);
  }
  target.displayed = target.normals.size();
  addDarkSides(mesh, box, target);
  return target;
}

std::vector<std::optional<ProbePlace>> placesOn(const Target& target, double reach, const glm::dvec3& origin,
                                                std::span<const Probe> probes,
                                                const CancelToken& cancel = {}) {
  const NearestTriangle nearest(target.positions, target.corners);
  std::vector<std::optional<ProbePlace>> places(probes.size());
  for (std::size_t k = 0; k < probes.size(); ++k) {
    cancel.check();
    if (k % kToldEvery == 0) cancel.report(static_cast<double>(k) / static_cast<double>(probes.size()));
    const glm::vec3 normal(glm::normalize(probes[k].normal));
    const auto faces = [&](std::uint32_t triangle) {
      return glm::dot(target.normals[triangle], normal) >= static_cast<float>(kLeastCosine);
    };
    const auto hit = nearest.find(glm::vec3(probes[k].position - origin), static_cast<float>(reach), faces);
    if (!hit) continue;
    ProbePlace place;
    place.dark = hit->triangle >= target.displayed;
    for (int corner = 0; corner < 3 && !place.dark; ++corner) {
      place.vertices[corner] = target.corners[3 * hit->triangle + static_cast<std::uint32_t>(corner)];
      place.weights[corner] = static_cast<double>(hit->weights[corner]);
    }
    places[k] = place;
  }
  return places;
}

/// The radiosity `of` a vertex, at each place.
template <class F>
std::vector<std::optional<glm::dvec3>> answer(const std::vector<std::optional<ProbePlace>>& places, F&& of) {
  std::vector<std::optional<glm::dvec3>> answers(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (places[k]) answers[k] = places[k]->value(of);
  }
  return answers;
}

double requiredNumber(const CsvTable& table, std::size_t row, std::size_t column) {
  const std::optional<double> value = table.number(row, column);
  if (!value || !std::isfinite(*value)) {
    throw Error(ErrorKind::kInput, "value " + std::to_string(column + 1) + " is missing or not finite",
                table.where(row), "x,y,z,nx,ny,nz in every line");
  }
  return *value;
}

}  // namespace

std::vector<Probe> readProbes(const std::filesystem::path& path) {
  const CsvTable table = readCsv(path);
  std::vector<Probe> probes;
  probes.reserve(table.rows.size());
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (table.rows[row].size() < 6) {
      throw Error(ErrorKind::kInput,
                  "a probe needs six values, here are " + std::to_string(table.rows[row].size()),
                  table.where(row), "x,y,z,nx,ny,nz in every line");
    }
    Probe probe;
    for (int k = 0; k < 3; ++k) {
      probe.position[k] = requiredNumber(table, row, static_cast<std::size_t>(k));
      probe.normal[k] = requiredNumber(table, row, static_cast<std::size_t>(k + 3));
    }
    const double length = glm::length(probe.normal);
    if (!(length > 0) || !std::isfinite(length)) {
      throw Error(ErrorKind::kInput, "the normal of this probe has no direction", table.where(row),
                  "the direction that the surface faces, such as 0,1,0");
    }
    probes.push_back(probe);
  }
  if (probes.empty()) {
    throw Error(ErrorKind::kInput, "the file has no probes", path.string(), "lines of x,y,z,nx,ny,nz");
  }
  return probes;
}

std::vector<std::optional<ProbePlace>> placeProbes(const Mesh& mesh, std::span<const Probe> probes) {
  const double reach = kReachOfDiagonal * glm::length(mesh.bounds_max - mesh.bounds_min);
  const Box box(probes, mesh.frame_origin, reach);
  return placesOn(targetOf(mesh, box), reach, mesh.frame_origin, probes);
}

std::vector<std::optional<glm::dvec3>> answerProbes(const Snapshot& snapshot, std::span<const Probe> probes,
                                                    bool with_ambient) {
  return answer(placeProbes(*snapshot.mesh, probes),
                [&](std::uint32_t vertex) { return radiosity(snapshot, vertex, with_ambient); });
}

std::vector<std::optional<glm::dvec3>> answerProbes(const PlySolution& solution,
                                                    std::span<const Probe> probes,
                                                    const CancelToken& cancel) {
  if (solution.triangles.empty())
    throw Error(ErrorKind::kInput, "the PLY file has no triangles", {},
                "a file written by unshot solve --ply");
  glm::dvec3 low = solution.positions.front(), high = low;
  for (const glm::dvec3& p : solution.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  // About the middle, where single precision is finest.
  const glm::dvec3 origin = 0.5 * (low + high);
  Target target;
  for (const glm::dvec3& p : solution.positions) target.positions.emplace_back(p - origin);
  for (std::size_t k = 0; k + 2 < solution.triangles.size(); k += 3)
    target.add(solution.triangles[k], solution.triangles[k + 1], solution.triangles[k + 2]);
  target.displayed = target.normals.size();
  return answer(placesOn(target, kReachOfDiagonal * glm::length(high - low), origin, probes, cancel),
                [&](std::uint32_t vertex) { return solution.radiosity[vertex]; });
}

std::string probeCsv(std::span<const Probe> probes, std::span<const std::optional<glm::dvec3>> answers) {
  std::string text = "x,y,z,nx,ny,nz,B_r,B_g,B_b\n";
  const auto append = [&](const auto& v) {
    text += shortest(v.x) + "," + shortest(v.y) + "," + shortest(v.z);
  };
  for (std::size_t k = 0; k < probes.size(); ++k) {
    append(probes[k].position);
    text += ",";
    append(probes[k].normal);
    text += ",";
    if (answers[k]) {
      append(glm::vec3(*answers[k]));
    } else {
      text += ",,";
    }
    text += "\n";
  }
  return text;
}

}  // namespace unshot

#include "cli/solution_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>

#include "base/colour.h"
#include "base/error.h"

namespace unshot {
namespace {

// Two triangles lie in one plane where normals and distances are this close (of 1, of the extent).
constexpr double kPlaneSteps = 1000;

struct Corners {
  glm::dvec3 p[3];
  glm::dvec3 cross() const { return glm::cross(p[1] - p[0], p[2] - p[0]); }
};

/// A mesh to be drawn and looked at for a camera: what lies in one plane is a surface, one element and one
/// side, white, so that irradiance is what is shown.
class MeshOfPly {
 public:
  explicit MeshOfPly(const PlySolution& solution) : mesh_(std::make_shared<Mesh>()) {
    Mesh& mesh = *mesh_;
    mesh.bounds_min = mesh.bounds_max = solution.positions.front();
    for (const glm::dvec3& p : solution.positions) {
      mesh.bounds_min = glm::min(mesh.bounds_min, p);
      mesh.bounds_max = glm::max(mesh.bounds_max, p);
    }
    mesh.frame_origin = 0.5 * (mesh.bounds_min + mesh.bounds_max);
    mesh.bounds_min -= mesh.frame_origin;
    mesh.bounds_max -= mesh.frame_origin;
    mesh.materials = {{"", glm::dvec3(1.0), glm::dvec3(0.0)}};
    for (const glm::dvec3& p : solution.positions) mesh.positions.push_back(p - mesh.frame_origin);
    mesh.vertices.resize(solution.positions.size());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      mesh.vertices[v].position = glm::vec3(mesh.positions[v]);
    mesh.triangle_vertices = solution.triangles;
    groupByPlane();
  }

  std::shared_ptr<const Mesh> get() const { return mesh_; }

 private:
  Corners cornersOf(std::size_t triangle) const {
    const std::uint32_t* v = &mesh_->triangle_vertices[3 * triangle];
    return {{mesh_->positions[v[0]], mesh_->positions[v[1]], mesh_->positions[v[2]]}};
  }

  void groupByPlane() {
    const double extent = glm::length(mesh_->bounds_max - mesh_->bounds_min);
    std::map<std::array<long, 4>, std::vector<std::uint32_t>> planes;
    for (std::uint32_t t = 0; t < mesh_->triangle_vertices.size() / 3; ++t) {
      const Corners c = cornersOf(t);
      const double length = glm::length(c.cross());
      const glm::dvec3 normal = length > 0 ? c.cross() / length : glm::dvec3(0, 0, 1);
      const glm::dvec3 n = kPlaneSteps * normal;
      planes[{std::lround(n.x), std::lround(n.y), std::lround(n.z),
              std::lround(kPlaneSteps * glm::dot(normal, c.p[0]) / extent)}]
          .push_back(t);
    }
    mesh_->triangle_element.resize(mesh_->triangle_vertices.size() / 3);
    for (const auto& [plane, triangles] : planes)
      addSurface(glm::normalize(glm::dvec3(plane[0], plane[1], plane[2])), triangles);
  }

  void addSurface(const glm::dvec3& normal, const std::vector<std::uint32_t>& triangles) {
    Mesh& mesh = *mesh_;
    const auto index = static_cast<std::uint32_t>(mesh.surfaces.size());
    Surface surface;
    surface.normal = normal;
    const glm::dvec3 other = std::abs(normal.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    surface.axis_u = glm::normalize(glm::cross(other, normal));
    surface.axis_v = glm::cross(normal, surface.axis_u);
    surface.origin = cornersOf(triangles.front()).p[0];
    surface.triangles = {static_cast<std::uint32_t>(mesh.triangles.size()),
                         static_cast<std::uint32_t>(triangles.size())};
    surface.side[0] = index;
    for (const std::uint32_t t : triangles) {
      const Corners corners = cornersOf(t);
      ChartTriangle chart{};
      for (int k = 0; k < 3; ++k) {
        chart.uv[k] = surface.chart(corners.p[k]);
        chart.position[k] = mesh.triangle_vertices[3 * t + static_cast<std::uint32_t>(k)];
        mesh.vertices[chart.position[k]].side = index;
        mesh.vertices[chart.position[k]].normal = glm::vec3(normal);
      }
      mesh.triangles.push_back(chart);
      mesh.triangle_element[t] = index;
      surface.area += glm::length(corners.cross()) / 2;
    }
    mesh.element_side.push_back(index);
    mesh.element_patch.push_back(index);
    mesh.element_area.push_back(surface.area);
    ++mesh.element_count;
    Side side;
    side.surface = index;
    side.normal = normal;
    side.reflectance = glm::dvec3(1.0);
    side.first_element = index;
    mesh.sides.push_back(side);
    mesh.surfaces.push_back(surface);
  }

  std::shared_ptr<Mesh> mesh_;
};

/// Of what is on the triangles: half of the area is brighter.
double medianLuminance(const Mesh& mesh, const std::vector<glm::dvec3>& radiosity) {
  std::vector<std::pair<double, double>> values;  // with its area
  double all = 0;
  for (std::size_t t = 0; t < mesh.triangle_vertices.size() / 3; ++t) {
    const std::uint32_t* v = &mesh.triangle_vertices[3 * t];
    const Corners c{{mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]}};
    values.emplace_back(luminance(radiosity[v[0]] + radiosity[v[1]] + radiosity[v[2]]) / 3,
                        glm::length(c.cross()));
    all += values.back().second;
  }
  std::sort(values.begin(), values.end());
  double below = 0;
  for (const auto& [value, area] : values) {
    below += area;
    if (2 * below >= all) return value;
  }
  return 0;
}

Snapshot snapshotOf(const std::shared_ptr<const Mesh>& mesh, const PlySolution& solution) {
  Snapshot out;
  out.mesh = mesh;
  out.irradiance.assign(solution.radiosity.begin(), solution.radiosity.end());
  std::vector<glm::dvec3> sum(mesh->element_count, glm::dvec3(0.0));
  for (std::size_t t = 0; t < mesh->triangle_element.size(); ++t) {
    const std::uint32_t* v = &mesh->triangle_vertices[3 * t];
    const Corners c{{mesh->positions[v[0]], mesh->positions[v[1]], mesh->positions[v[2]]}};
    const glm::dvec3 mean =
        (solution.radiosity[v[0]] + solution.radiosity[v[1]] + solution.radiosity[v[2]]) / 3.0;
    sum[mesh->triangle_element[t]] += glm::length(c.cross()) / 2 * mean;
  }
  for (std::size_t e = 0; e < sum.size(); ++e) {
    const double area = mesh->element_area[e];
    out.element_irradiance.emplace_back(area > 0 ? sum[e] / area : glm::dvec3(0.0));
  }
  return out;
}

}  // namespace

SolutionDifference drawDifference(gl::Context& context, const PlySolution& a, const PlySolution& b,
                                  PictureOptions options) {
  if (a.triangles.empty()) {
    throw Error(ErrorKind::kInput, "the PLY files have no triangles to draw", {},
                "files written by unshot solve --ply");
  }
  const std::shared_ptr<const Mesh> mesh = MeshOfPly(a).get();
  ReferenceLight reference = referenceLight(mesh, b.radiosity, "B");
  reference.mean = medianLuminance(*mesh, b.radiosity);
  options.reference = std::make_shared<const ReferenceLight>(reference);
  options.display = "difference";
  options.linear = false;
  // The camera is chosen for B, as for a picture of it.
  const Camera camera = pictureCamera(context, snapshotOf(mesh, b), options);
  options.eye = camera.eye + mesh->frame_origin;
  options.at = camera.at + mesh->frame_origin;
  options.fov_deg = camera.fov_deg;
  return {renderPicture(context, snapshotOf(mesh, a), options).srgb, reference.mean};
}

}  // namespace unshot

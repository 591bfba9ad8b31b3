#include "formfactor/hemicube_rays.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <thread>

#include "mesh/lit.h"

namespace unshot {
namespace {

// An eye this share of the scene's size above its surface cannot hit it by rounding.
constexpr double kLift = 1e-6;

constexpr std::size_t kPixelsWorthAThread = 8192;

FirstHits makeRays(const Mesh& mesh, const CancelToken& cancel) {
  std::vector<glm::vec3> positions;
  for (const glm::dvec3& p : mesh.positions) positions.emplace_back(p);
  cancel.check();
  std::vector<std::uint32_t> corners;
  for (const ChartTriangle& t : litTriangles(mesh)) corners.insert(corners.end(), t.position, t.position + 3);
  return {positions, corners, cancel};
}

}  // namespace

HemicubeRays::HemicubeRays(const Mesh& mesh, const CancelToken& cancel)
    : mesh_(mesh), far_(2 * glm::length(mesh.bounds_max - mesh.bounds_min)), rays_(makeRays(mesh, cancel)) {
  triangles_.resize(litTriangles(mesh).size());
  for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s) {
    cancel.check();
    const Surface& surface = mesh.surfaces[s];
    if (surface.triangles.end() > triangles_.size()) continue;
    for (std::uint32_t t = surface.triangles.first; t < surface.triangles.end(); ++t) {
      triangles_[t].surface = s;
      const glm::dmat3 heights = outlineHeights(mesh.triangles[t], far_);
      for (int k = 0; k < 3; ++k) {
        triangles_[t].chart[k] = glm::vec2(mesh.triangles[t].uv[k] / surface.extent);
        // An inner edge is far from every point of the triangle, not only from its apex.
        triangles_[t].apex_height[k] =
            mesh.triangles[t].outline[k] ? static_cast<float>(heights[(k + 2) % 3][k]) : INFINITY;
      }
    }
  }
}

Item HemicubeRays::itemOf(const FirstHits::Hit& hit, const glm::vec3& direction) const {
  if (hit.triangle == kNone) return {kNone, 0};
  const Triangle& t = triangles_[hit.triangle];
  const float weight[3] = {1 - hit.weight1 - hit.weight2, hit.weight1, hit.weight2};
  const glm::vec2 chart =
      glm::clamp(weight[0] * t.chart[0] + weight[1] * t.chart[1] + weight[2] * t.chart[2], 0.0f, 1.0f);
  bool tie = false;
  for (int e = 0; e < 3; ++e) {
    tie = tie || (t.apex_height[e] != INFINITY &&
                  weight[(e + 2) % 3] * t.apex_height[e] < static_cast<float>(kTieMargin * far_));
  }
  const bool back = glm::dot(glm::dvec3(direction), mesh_.surfaces[t.surface].normal) > 0;
  const auto quantised = [](float x) { return static_cast<std::uint32_t>(x * 65535.99f); };
  return {(tie ? 0x80000000u : 0u) | t.surface << 1 | (back ? 1u : 0u),
          quantised(chart.x) | quantised(chart.y) << 16};
}

HemicubeView::Result HemicubeRays::look(const HemicubeFrame& frame, HemicubeLayout layout) {
  const std::size_t pixels = std::size_t{layout.width()} * layout.height();
  directions_.resize(pixels);
  hits_.resize(pixels);
  items_.resize(pixels);
  distance_.resize(pixels);
  // Pixels are independent, so the rows are shared out: the result is the same with any number of threads.
  const std::uint32_t most = std::max(1u, std::thread::hardware_concurrency());
  const auto threads =
      static_cast<std::uint32_t>(std::clamp<std::size_t>(pixels / kPixelsWorthAThread, 1, most));
  std::vector<std::jthread> helpers;
  for (std::uint32_t k = 1; k < threads; ++k) {
    helpers.emplace_back([&, k] {
      traceRows(frame, layout, layout.height() * k / threads, layout.height() * (k + 1) / threads);
    });
  }
  traceRows(frame, layout, 0, layout.height() / threads);
  helpers.clear();
  return {items_, distance_, far_};
}

void HemicubeRays::traceRows(const HemicubeFrame& frame, HemicubeLayout layout, std::uint32_t first_row,
                             std::uint32_t end_row) {
  const std::uint32_t n = layout.resolution;
  const HemicubeFaces faces(frame);
  for (std::uint32_t row = first_row; row < end_row; ++row) {
    const std::uint32_t face = row < n ? 0 : 1 + (row - n) / (n / 2);
    const double y = (row - layout.faceRow(face) + 0.5) * 2 / n - (face == 0 ? 1 : 0);
    const glm::vec3 start(faces.forward[face] + y * faces.up[face]);
    const glm::vec3 side(glm::cross(faces.forward[face], faces.up[face]));
    for (std::uint32_t i = 0; i < n; ++i) {
      const float x = (static_cast<float>(i) + 0.5f) * 2 / static_cast<float>(n) - 1;
      directions_[std::size_t{row} * n + i] = glm::normalize(start + x * side);
    }
  }
  const std::size_t first = std::size_t{first_row} * n, count = std::size_t{end_row - first_row} * n;
  rays_.trace(glm::vec3(frame.eye + kLift * far_ * frame.normal), static_cast<float>(frame.near_distance),
              std::span(directions_).subspan(first, count), std::span(hits_).subspan(first, count));
  for (std::size_t k = first; k < first + count; ++k) {
    items_[k] = itemOf(hits_[k], directions_[k]);
    distance_[k] = hits_[k].triangle == kNone ? 1.0f : static_cast<float>(hits_[k].distance / far_);
  }
}

}  // namespace unshot

#include "render/view_judge.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <utility>

#include "base/colour.h"
#include "mesh/grid.h"
#include "render/exposure.h"

namespace unshot {
namespace {

constexpr double kNear = 0.06;       // of the scene's diagonal: nearer things block the view
constexpr double kDark = 0.05;       // of the median luminance of the scene
constexpr double kOpen = 0.1;        // of the frame: so much background between surfaces makes a scene open
constexpr double kSmall = 8;         // pixels: a side that has fewer cannot be made out
constexpr double kNearBlack = 0.03;  // exposed values below which little is made out
constexpr double kBlown = 1.3;       // and above which all is white

// Means over the corners of each element's display triangles.
std::vector<glm::dvec3> elementAmbient(const Snapshot& snapshot) {
  const Mesh& mesh = *snapshot.mesh;
  std::vector<glm::dvec3> sum(mesh.element_count, glm::dvec3(0.0));
  std::vector<double> count(mesh.element_count, 0.0);
  if (snapshot.ambient.size() < mesh.vertices.size()) return sum;
  for (std::size_t k = 0; k < mesh.triangle_vertices.size(); ++k) {
    const std::uint32_t e = mesh.triangle_element[k / 3];
    sum[e] += glm::dvec3(snapshot.ambient[mesh.triangle_vertices[k]]);
    ++count[e];
  }
  for (std::size_t e = 0; e < sum.size(); ++e) sum[e] /= std::max(count[e], 1.0);
  return sum;
}

// Half of the area of front sides (all sides where they have no light) is brighter than this; lamps aside.
double medianLuminance(const Mesh& mesh, const SceneLight& light, bool backs) {
  std::vector<std::pair<double, double>> values;
  double total = 0;
  for (std::size_t e = 0; e < light.elements.size(); ++e) {
    const std::uint32_t side = mesh.element_side[e];
    if (light.sides[side].emits || (mesh.sides[side].back && !backs)) continue;
    values.emplace_back(light.elements[e], mesh.element_area[e]);
    total += mesh.element_area[e];
  }
  std::sort(values.begin(), values.end());
  double below = 0;
  for (const auto& [y, area] : values) {
    below += area;
    if (below >= 0.5 * total && (y > 0 || backs)) return y;
  }
  return backs ? 0 : medianLuminance(mesh, light, true);
}

// Whether the ray from `eye` meets the box.
bool meets(const Bounds& box, const glm::dvec3& eye, const glm::dvec3& ray) {
  double from = 0;
  double to = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (ray[i] == 0) {
      if (eye[i] < box.min[i] || eye[i] > box.max[i]) return false;
      continue;
    }
    const double a = (box.min[i] - eye[i]) / ray[i];
    const double b = (box.max[i] - eye[i]) / ray[i];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return from <= to;
}

// Goes over the pixels of a view and counts.
class Judge {
 public:
  Judge(int width, int height, const Camera& camera, const Mesh& mesh, const SceneLight& light)
      : width_(static_cast<std::size_t>(width)),
        height_(static_cast<std::size_t>(height)),
        camera_(camera),
        mesh_(mesh),
        light_(light),
        bounds_{mesh.bounds_min, mesh.bounds_max},
        basis_(viewBasis(camera)),
        pixels_of_(mesh.sides.size(), 0),
        at_border_(mesh.sides.size(), 0) {
    tan_y_ = std::tan(0.5 * camera.fov_deg * glm::pi<double>() / 180);
    tan_x_ = tan_y_ * width / height;
  }

  ViewFigures run(std::span<const std::uint32_t> ids) {
    shown_.reserve(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) count(i % width_, i / width_, ids[i]);
    ViewFigures figures;
    if (shown_.empty()) return figures;
    judgeSides(figures);
    judgeLight(figures);
    const double all = static_cast<double>(width_ * height_);
    const double covered = static_cast<double>(shown_.size());
    figures.covered = covered / all;
    figures.lit = lit_ / in_bounds_;
    figures.blocked = blocked_ / all;
    double cut = 0;
    for (std::size_t s = 0; s < pixels_of_.size(); ++s) {
      if (at_border_[s]) cut += pixels_of_[s];
    }
    figures.cut = cut / covered * std::min(1.0, (in_bounds_ - covered) / (kOpen * all));
    return figures;
  }

 private:
  void count(std::size_t column, std::size_t row, std::uint32_t id) {
    const double x = 2 * (static_cast<double>(column) + 0.5) / static_cast<double>(width_) - 1;
    const double y = 2 * (static_cast<double>(row) + 0.5) / static_cast<double>(height_) - 1;
    const glm::dvec3 ray =
        glm::normalize(basis_.forward + tan_x_ * x * basis_.right + tan_y_ * y * basis_.up);
    if (id != 0 || meets(bounds_, camera_.eye, ray)) ++in_bounds_;
    if (id == 0) return;
    const std::uint32_t side = id - 1;
    ++pixels_of_[side];
    if (column == 0 || row == 0 || column + 1 == width_ || row + 1 == height_) at_border_[side] = 1;
    const Surface& surface = mesh_.surfaces[mesh_.sides[side].surface];
    const double along = glm::dot(ray, surface.normal);
    const double distance = along == 0 ? 0 : glm::dot(surface.origin - camera_.eye, surface.normal) / along;
    if (distance < kNear * bounds_.diagonal()) ++blocked_;
    const double y_seen = luminanceAt(side, camera_.eye + distance * ray);
    if (light_.median == 0 || y_seen > kDark * light_.median) ++lit_;
    shown_.emplace_back(glm::vec3(static_cast<float>(y_seen)),
                        light_.sides[side].emits ? kEmitterPixel : kSurfacePixel);
  }

  double luminanceAt(std::uint32_t side, const glm::dvec3& point) const {
    const Surface& surface = mesh_.surfaces[mesh_.sides[side].surface];
    if (surface.elements.count != 0) {
      const std::uint32_t local = elementAt(mesh_, surface, surface.chart(point));
      if (local != kNone) return light_.elements[mesh_.sides[side].first_element + local];
    }
    return light_.sides[side].luminance;
  }

  // Figures that follow from how many pixels each side has.
  void judgeSides(ViewFigures& figures) const {
    double backs = 0, lamps = 0, small = 0, seen = 0, total = 0;
    double entropy = 0;  // of the pixels over the sides: log covered - sum n log n / covered
    const double covered = static_cast<double>(shown_.size());
    for (std::size_t s = 0; s < pixels_of_.size(); ++s) {
      const SideLook& look = light_.sides[s];
      const double n = pixels_of_[s];
      total += look.area;
      if (n == 0) continue;
      seen += look.area;
      entropy -= n * std::log(n);
      if (mesh_.sides[s].back && !look.emits) backs += n;
      if (look.emits) lamps += n;
      if (n < kSmall) small += n;
    }
    figures.backs = backs / covered;
    figures.small = small / covered;
    figures.lamps = std::sqrt(std::min(1.0, lamps / (0.01 * static_cast<double>(width_ * height_))));
    figures.seen = total > 0 ? seen / total : 0;
    figures.variety = std::clamp((entropy / covered + std::log(covered)) / std::log(1024.0), 0.0, 1.0);
  }

  void judgeLight(ViewFigures& figures) const {
    const double exposure = automaticExposure(shown_);
    double sum = 0, squares = 0, count = 0, surfaces = 0, clear = 0;
    for (const glm::vec4& p : shown_) {
      if (p.w != kSurfacePixel) continue;
      ++surfaces;
      const double exposed = exposure * static_cast<double>(p.x);
      if (exposed > kNearBlack && exposed < kBlown) ++clear;
      if (p.x <= 0) continue;
      const double l = std::log(static_cast<double>(p.x));
      ++count;
      sum += l;
      squares += l * l;
    }
    if (count > 0)
      figures.contrast =
          std::min(1.0, std::sqrt(std::max(0.0, squares / count - sum * sum / (count * count))));
    if (surfaces > 0) figures.clear = clear / surfaces;
  }

  std::size_t width_, height_;
  const Camera& camera_;
  const Mesh& mesh_;
  const SceneLight& light_;
  Bounds bounds_;
  ViewBasis basis_;
  double tan_x_ = 1, tan_y_ = 1;
  std::vector<std::uint32_t> pixels_of_;  // per side
  std::vector<char> at_border_;           // per side: the frame cuts it
  std::vector<glm::vec4> shown_;          // covered pixels: luminance and class
  double in_bounds_ = 0, lit_ = 0, blocked_ = 0;
};

}  // namespace

SceneLight sceneLight(const Snapshot& snapshot) {
  const Mesh& mesh = *snapshot.mesh;
  const std::vector<glm::dvec3> ambient = elementAmbient(snapshot);
  SceneLight light;
  light.sides.resize(mesh.sides.size());
  light.elements.resize(mesh.element_count);
  for (std::size_t e = 0; e < light.elements.size(); ++e) {
    const Side& side = mesh.sides[mesh.element_side[e]];
    glm::dvec3 h = ambient[e];
    if (e < snapshot.element_irradiance.size()) h += glm::dvec3(snapshot.element_irradiance[e]);
    const double y = luminance(side.emission + side.reflectance * h);
    light.elements[e] = std::isfinite(y) ? static_cast<float>(std::clamp(y, 0.0, 1e36)) : 0.0f;
    light.sides[mesh.element_side[e]].luminance += mesh.element_area[e] * double{light.elements[e]};
  }
  for (std::size_t s = 0; s < light.sides.size(); ++s) {
    SideLook& look = light.sides[s];
    look.area = mesh.surfaces[mesh.sides[s].surface].area;
    look.emits = luminance(mesh.sides[s].emission) > 0;
    if (look.area > 0) look.luminance /= look.area;
  }
  light.median = medianLuminance(mesh, light, false);
  return light;
}

ViewFigures judgeView(std::span<const std::uint32_t> ids, int width, int height, const Camera& camera,
                      const Mesh& mesh, const SceneLight& light) {
  return Judge(width, height, camera, mesh, light).run(ids);
}

double viewScore(const ViewFigures& figures, const ViewFigures& best) {
  const auto relative = [](double value, double largest) { return largest > 0 ? value / largest : 0; };
  const double shows = figures.lit + 0.3 * figures.covered + 0.4 * relative(figures.variety, best.variety) +
                       0.7 * relative(figures.seen, best.seen) + 0.3 * relative(figures.lamps, best.lamps);
  const double light = 0.3 * figures.contrast + 0.3 * figures.clear;
  // A few back sides are seen through any open wall; most of a view is backs only from within a solid.
  const double inside_out = 0.6 * figures.backs + 2 * std::max(0.0, figures.backs - 0.5);
  return shows + light - inside_out - 0.8 * figures.blocked - 0.6 * figures.cut - 0.8 * figures.small;
}

}  // namespace unshot

#include "render/automatic_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "render/side_pictures.h"
#include "render/targets.h"
#include "render/view_judge.h"

namespace unshot {
namespace {

constexpr int kLookHeight = 72;
constexpr double kDrawnTriangles = 7e6;        // all candidates together: about a second in software
constexpr std::size_t kFewestCandidates = 26;  // all kinds but the last two

// From `reach` (1: the box's wall) of the way that `way` leads away from the middle, in the plane across
// `up`; `height` in half heights of the box above the middle. It looks across the middle, a little down.
Camera acrossBounds(const Bounds& bounds, const glm::dvec3& way, double reach, double height,
                    const glm::dvec3& up, double fov_deg) {
  const glm::dvec3 half = 0.5 * (bounds.max - bounds.min);
  double wall = 1e300;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(way[i]) > 1e-9) wall = std::min(wall, half[i] / std::abs(way[i]));
  }
  const glm::dvec3 rise = glm::dot(glm::abs(glm::normalize(up)), half) * glm::normalize(up);
  Camera camera;
  camera.eye = bounds.centre() + reach * wall * way + height * rise;
  camera.at = bounds.centre() - 0.5 * wall * way + (0.4 * height - 0.1) * rise;
  camera.up = up;
  camera.fov_deg = fov_deg;
  return camera;
}

}  // namespace

std::vector<CameraCandidate> cameraCandidates(const Bounds& bounds, const AutomaticCameraOptions& options) {
  const ViewBasis level = viewBasis({{0, 0, 0}, {0, 0, -1}, options.up, 40});
  const glm::dvec3 up = glm::normalize(options.up);
  const auto heading = [&](double azimuth_deg, double elevation_deg) {
    const double a = azimuth_deg * glm::pi<double>() / 180;
    const double e = elevation_deg * glm::pi<double>() / 180;
    const glm::dvec3 forward = glm::normalize(glm::cross(up, level.right));
    return std::cos(e) * (std::cos(a) * forward + std::sin(a) * level.right) - std::sin(e) * up;
  };
  std::vector<CameraCandidate> candidates;
  const double outside_fov = options.fov_deg.value_or(40);
  const double inside_fov = options.fov_deg.value_or(65);
  // From outside: straight at the four faces (how the Cornell box is published), then from above.
  for (int azimuth = 0; azimuth < 360; azimuth += 90) {
    candidates.push_back(
        {frameBounds(bounds, heading(azimuth, 0), options.up, outside_fov, options.aspect, 0.98), 0.25});
  }
  for (int azimuth = 30; azimuth < 390; azimuth += 60) {
    candidates.push_back(
        {frameBounds(bounds, heading(azimuth, 28), options.up, outside_fov, options.aspect, 1.0), 0.0});
  }
  // Across the scene, from its corners and the middles of its faces, a little inside; from half way there
  // too.
  const auto across = [&](double reach, double height) {
    for (int k = 0; k < 8; ++k)
      candidates.push_back(
          {acrossBounds(bounds, -heading(45 * k, 0), reach, height, options.up, inside_fov), 0.0});
  };
  across(0.88, 0.2);
  across(0.3, 0.2);
  for (int azimuth = 0; azimuth < 360; azimuth += 60) {
    candidates.push_back(
        {frameBounds(bounds, heading(azimuth, 48), options.up, outside_fov, options.aspect, 1.0), 0.0});
  }
  across(0.88, 0.6);
  return candidates;
}

struct CameraSearch::Impl {
  gl::Context& context;
  std::shared_ptr<const Snapshot> snapshot;
  int width;
  std::vector<CameraCandidate> candidates;
  std::optional<SidePictures> pictures;
  SceneLight light;
  std::vector<ViewFigures> figures;  // of the candidates judged so far

  const Mesh& mesh() const { return *snapshot->mesh; }
};

CameraSearch::CameraSearch(gl::Context& context, std::shared_ptr<const Snapshot> snapshot,
                           const AutomaticCameraOptions& options)
    : impl_(std::make_unique<Impl>(Impl{context, std::move(snapshot), 0, {}, {}, {}, {}})) {
  Impl& s = *impl_;
  if (s.mesh().sides.empty()) return;  // nothing to look at
  s.candidates = cameraCandidates({s.mesh().bounds_min, s.mesh().bounds_max}, options);
  s.width = std::clamp(static_cast<int>(std::lround(kLookHeight * options.aspect)), 8, 1024);
  const StateGuard guard(context.functions());
  s.pictures.emplace(context, s.mesh(), s.width, kLookHeight);
  const auto triangles = static_cast<double>(std::max(s.pictures->triangles(), 1));
  const auto affordable = static_cast<std::size_t>(kDrawnTriangles / triangles);
  s.candidates.resize(std::min(s.candidates.size(), std::max(kFewestCandidates, affordable)));
  s.light = sceneLight(*s.snapshot);
}

CameraSearch::~CameraSearch() = default;
CameraSearch::CameraSearch(CameraSearch&&) noexcept = default;
CameraSearch& CameraSearch::operator=(CameraSearch&&) noexcept = default;

bool CameraSearch::step() {
  Impl& s = *impl_;
  if (s.figures.size() == s.candidates.size()) return false;
  const StateGuard guard(s.context.functions());
  const Camera& camera = s.candidates[s.figures.size()].camera;
  s.figures.push_back(judgeView(s.pictures->look(camera), s.width, kLookHeight, camera, s.mesh(), s.light));
  return true;
}

double CameraSearch::done() const {
  const Impl& s = *impl_;
  return s.candidates.empty()
             ? 1
             : static_cast<double>(s.figures.size()) / static_cast<double>(s.candidates.size());
}

Camera CameraSearch::best() const {
  const Impl& s = *impl_;
  if (s.candidates.empty()) return {};
  ViewFigures best;
  for (const ViewFigures& f : s.figures) {
    best.variety = std::max(best.variety, f.variety);
    best.seen = std::max(best.seen, f.seen);
    best.lamps = std::max(best.lamps, f.lamps);
  }
  std::size_t chosen = 0;
  double most = -1e300;
  for (std::size_t i = 0; i < s.figures.size(); ++i) {
    const double points = viewScore(s.figures[i], best) + s.candidates[i].prior;
    if (points <= most) continue;
    most = points;
    chosen = i;
  }
  return s.candidates[chosen].camera;
}

Camera automaticCamera(gl::Context& context, const Snapshot& snapshot,
                       const AutomaticCameraOptions& options) {
  // The search does not outlive the snapshot here.
  CameraSearch search(context, std::shared_ptr<const Snapshot>(std::shared_ptr<void>(), &snapshot), options);
  while (search.step()) {
  }
  return search.best();
}

}  // namespace unshot

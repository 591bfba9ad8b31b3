#include "render/automatic_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <utility>

#include "base/colour.h"
#include "gl/objects.h"
#include "render/targets.h"

namespace unshot {
namespace {

constexpr int kLookHeight = 72;
constexpr double kNear = 0.1;              // of the scene's diagonal: nearer things block the view
constexpr double kDark = 0.05;             // of the median luminance of the sides
constexpr double kDrawnTriangles = 1.2e7;  // all candidates together: about a second in software
constexpr std::size_t kFewestCandidates = 20;
constexpr double kOpen = 0.1;  // of the frame: so much background between the surfaces makes a scene open

// The scene's polygons with their sides, drawn as ids.
class SidePictures {
 public:
  SidePictures(gl::Context& context, const Mesh& mesh, int width)
      : context_(context),
        bounds_{mesh.bounds_min, mesh.bounds_max},
        program_(context, {"side_id.vert", "side_id.frag"}),
        vertices_(context),
        vertex_array_(context),
        ids_(context),
        depth_(context),
        framebuffer_(context),
        width_(width) {
    upload(mesh);
    const gl::Functions& fn = context.functions();
    fn.BindTexture(GL_TEXTURE_2D, ids_.id());
    fn.TexImage2D(GL_TEXTURE_2D, 0, GL_R32UI, width, kLookHeight, 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
                  nullptr);
    fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    fn.BindTexture(GL_TEXTURE_2D, 0);
    fn.BindRenderbuffer(GL_RENDERBUFFER, depth_.id());
    fn.RenderbufferStorage(GL_RENDERBUFFER, DepthSetup(fn).format, width, kLookHeight);
    fn.BindRenderbuffer(GL_RENDERBUFFER, 0);
    fn.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    fn.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, ids_.id(), 0);
    fn.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
    framebuffer_.checkComplete("a picture of ids");
  }

  GLsizei triangles() const { return vertex_count_ / 3; }

  std::vector<std::uint32_t> look(const Camera& camera) {
    const gl::Functions& fn = context_.functions();
    fn.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    fn.Viewport(0, 0, width_, kLookHeight);
    setPassState(fn, true);
    const GLuint nothing[4] = {};
    const DepthSetup depth(fn);
    fn.ClearBufferuiv(GL_COLOR, 0, nothing);
    fn.ClearBufferfv(GL_DEPTH, 0, &depth.farthest);
    program_.use();
    const double aspect = static_cast<double>(width_) / kLookHeight;
    const glm::mat4 matrix = viewProjection(camera, aspect, bounds_, {}, depth.range);
    fn.UniformMatrix4fv(program_.uniform("view_projection"), 1, GL_FALSE, glm::value_ptr(matrix));
    fn.BindVertexArray(vertex_array_.id());
    fn.DrawArrays(GL_TRIANGLES, 0, vertex_count_);
    fn.BindVertexArray(0);
    std::vector<std::uint32_t> ids(static_cast<std::size_t>(width_) * kLookHeight);
    fn.ReadPixels(0, 0, width_, kLookHeight, GL_RED_INTEGER, GL_UNSIGNED_INT, ids.data());
    return ids;
  }

 private:
  struct IdVertex {
    glm::vec3 position;
    std::uint32_t side;
  };

  void upload(const Mesh& mesh) {
    std::vector<IdVertex> vertices;
    for (std::uint32_t s = 0; s < mesh.sides.size(); ++s) {
      const Surface& surface = mesh.surfaces[mesh.sides[s].surface];
      for (std::uint32_t t = surface.triangles.first; t < surface.triangles.end(); ++t) {
        const ChartTriangle& triangle = mesh.triangles[t];
        for (int k = 0; k < 3; ++k) {
          const int corner = mesh.sides[s].back ? 2 - k : k;
          vertices.push_back({glm::vec3(mesh.positions[triangle.position[corner]]), s});
        }
      }
    }
    vertex_count_ = static_cast<GLsizei>(vertices.size());
    const gl::Functions& fn = context_.functions();
    fn.BindVertexArray(vertex_array_.id());
    fn.BindBuffer(GL_ARRAY_BUFFER, vertices_.id());
    fn.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(IdVertex)),
                  vertices.data(), GL_STATIC_DRAW);
    fn.EnableVertexAttribArray(0);
    fn.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(IdVertex), nullptr);
    fn.EnableVertexAttribArray(1);
    fn.VertexAttribIPointer(1, 1, GL_UNSIGNED_INT, sizeof(IdVertex),
                            reinterpret_cast<const void*>(offsetof(IdVertex, side)));
    fn.BindBuffer(GL_ARRAY_BUFFER, 0);
    fn.BindVertexArray(0);
  }

  gl::Context& context_;
  Bounds bounds_;
  gl::Program program_;
  gl::Buffer vertices_;
  gl::VertexArray vertex_array_;
  gl::Texture ids_;
  gl::Renderbuffer depth_;
  gl::Framebuffer framebuffer_;
  int width_;
  GLsizei vertex_count_ = 0;
};

// Distance along the unit direction `ray` to the side's plane.
double distanceTo(const Mesh& mesh, std::uint32_t side, const glm::dvec3& eye, const glm::dvec3& ray) {
  const Surface& surface = mesh.surfaces[mesh.sides[side].surface];
  const double along = glm::dot(ray, surface.normal);
  return along == 0 ? 0 : glm::dot(surface.origin - eye, surface.normal) / along;
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

// Half of the area (lamps aside) is brighter than this; 0 while the light has not reached half of it.
double medianLuminance(std::span<const SideLook> looks) {
  std::vector<std::pair<double, double>> values;
  double total = 0;
  for (const SideLook& look : looks) {
    if (look.emits) continue;
    values.emplace_back(look.luminance, look.area);
    total += look.area;
  }
  std::sort(values.begin(), values.end());
  double below = 0;
  for (const auto& [y, area] : values) {
    below += area;
    if (below >= 0.5 * total) return y;
  }
  return 0;
}

// The figures that follow from how many pixels each side has.
ViewFigures judgeSides(std::span<const std::uint32_t> pixels_of, double all_pixels, const Mesh& mesh,
                       std::span<const SideLook> looks) {
  double covered = 0, backs = 0, lamps = 0, seen = 0, total = 0, log_count = 0, log_sum = 0, log_squares = 0;
  double entropy = 0;  // of the pixels over the sides: log covered - sum n log n / covered
  for (std::size_t s = 0; s < pixels_of.size(); ++s) {
    const SideLook& look = looks[s];
    const double n = pixels_of[s];
    total += look.area;
    if (n == 0) continue;
    covered += n;
    seen += look.area;
    entropy -= n * std::log(n);
    if (mesh.sides[s].back && !look.emits) backs += n;
    if (look.emits) lamps += n;
    if (look.luminance > 0 && !look.emits) {
      const double l = std::log(look.luminance);
      log_count += n;
      log_sum += n * l;
      log_squares += n * l * l;
    }
  }
  ViewFigures figures;
  if (covered == 0) return figures;
  figures.covered = covered / all_pixels;
  figures.backs = backs / covered;
  figures.lamps = std::sqrt(std::min(1.0, lamps / (0.01 * all_pixels)));
  figures.seen = total > 0 ? seen / total : 0;
  figures.variety = std::clamp((entropy / covered + std::log(covered)) / std::log(64.0), 0.0, 1.0);
  if (log_count > 0) {
    const double mean = log_sum / log_count;
    figures.contrast = std::min(1.0, std::sqrt(std::max(0.0, log_squares / log_count - mean * mean)));
  }
  return figures;
}

double score(const ViewFigures& figures, const ViewFigures& best) {
  const auto relative = [](double value, double largest) { return largest > 0 ? value / largest : 0; };
  return figures.lit + 0.3 * figures.covered + 0.4 * relative(figures.variety, best.variety) +
         0.7 * relative(figures.seen, best.seen) + 0.3 * figures.contrast +
         0.3 * relative(figures.lamps, best.lamps) - 0.8 * figures.blocked - 0.6 * figures.backs -
         0.6 * figures.cut;
}

}  // namespace

std::vector<SideLook> sideLooks(const Snapshot& snapshot) {
  const Mesh& mesh = *snapshot.mesh;
  std::vector<SideLook> looks(mesh.sides.size());
  std::vector<double> sums(mesh.sides.size(), 0.0);
  for (std::size_t e = 0; e < std::min(snapshot.element_irradiance.size(), mesh.element_side.size()); ++e) {
    const double h =
        luminance(glm::dvec3(snapshot.element_irradiance[e]) * mesh.sides[mesh.element_side[e]].reflectance);
    if (std::isfinite(h)) sums[mesh.element_side[e]] += mesh.element_area[e] * h;
  }
  for (std::size_t s = 0; s < looks.size(); ++s) {
    const Side& side = mesh.sides[s];
    SideLook& look = looks[s];
    look.area = mesh.surfaces[side.surface].area;
    look.emits = luminance(side.emission) > 0;
    look.luminance = (look.area > 0 ? sums[s] / look.area : 0) + luminance(side.emission);
  }
  return looks;
}

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
  // From the corners and the middles of the faces, a little inside, across the scene.
  const glm::dvec3 centre = bounds.centre();
  const glm::dvec3 half = 0.5 * (bounds.max - bounds.min);
  for (const double height : {0.2, 0.6}) {
    for (int k = 0; k < 8; ++k) {
      const glm::dvec3 way = -heading(45 * k, 0);
      // To the box's wall along the way, in the plane across `up`.
      double reach = 1e300;
      for (int i = 0; i < 3; ++i) {
        if (std::abs(way[i]) > 1e-9) reach = std::min(reach, half[i] / std::abs(way[i]));
      }
      const double up_reach = glm::dot(glm::abs(up), half);
      Camera camera;
      camera.eye = centre + 0.88 * reach * way + height * up_reach * up;
      camera.at = centre - 0.5 * reach * way + (0.4 * height - 0.1) * up_reach * up;
      camera.up = options.up;
      camera.fov_deg = inside_fov;
      candidates.push_back({camera, 0.0});
    }
  }
  for (int azimuth = 0; azimuth < 360; azimuth += 60) {
    candidates.push_back(
        {frameBounds(bounds, heading(azimuth, 48), options.up, outside_fov, options.aspect, 1.0), 0.0});
  }
  return candidates;
}

ViewFigures judgeView(std::span<const std::uint32_t> ids, int width, int height, const Camera& camera,
                      const Mesh& mesh, std::span<const SideLook> looks) {
  const Bounds bounds{mesh.bounds_min, mesh.bounds_max};
  const ViewBasis basis = viewBasis(camera);
  const double tan_y = std::tan(0.5 * camera.fov_deg * glm::pi<double>() / 180);
  const double tan_x = tan_y * width / height;
  const double median = medianLuminance(looks);
  std::vector<std::uint32_t> pixels_of(mesh.sides.size(), 0);
  std::vector<bool> at_border(mesh.sides.size(), false);
  double in_bounds = 0, lit = 0, blocked = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::size_t column = i % static_cast<std::size_t>(width);
    const std::size_t row = i / static_cast<std::size_t>(width);
    const double x = 2 * (static_cast<double>(column) + 0.5) / width - 1;
    const double y = 2 * (static_cast<double>(row) + 0.5) / height - 1;
    const glm::dvec3 ray = glm::normalize(basis.forward + tan_x * x * basis.right + tan_y * y * basis.up);
    if (ids[i] != 0 || meets(bounds, camera.eye, ray)) ++in_bounds;
    if (ids[i] == 0) continue;
    const std::uint32_t side = ids[i] - 1;
    ++pixels_of[side];
    if (column == 0 || row == 0 || column + 1 == static_cast<std::size_t>(width) ||
        row + 1 == static_cast<std::size_t>(height))
      at_border[side] = true;
    if (median == 0 || looks[side].luminance > kDark * median) ++lit;
    if (distanceTo(mesh, side, camera.eye, ray) < kNear * bounds.diagonal()) ++blocked;
  }
  const double all_pixels = static_cast<double>(width) * height;
  ViewFigures figures = judgeSides(pixels_of, all_pixels, mesh, looks);
  if (in_bounds > 0) figures.lit = lit / in_bounds;
  figures.blocked = blocked / all_pixels;
  const double covered = figures.covered * all_pixels;
  double cut = 0;
  for (std::size_t s = 0; s < pixels_of.size(); ++s) {
    if (at_border[s]) cut += pixels_of[s];
  }
  if (covered > 0) figures.cut = cut / covered * std::min(1.0, (in_bounds - covered) / (kOpen * all_pixels));
  return figures;
}

struct CameraSearch::Impl {
  gl::Context& context;
  std::shared_ptr<const Snapshot> snapshot;
  int width;
  std::vector<CameraCandidate> candidates;
  std::optional<SidePictures> pictures;
  std::vector<SideLook> looks;
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
  s.pictures.emplace(context, s.mesh(), s.width);
  const auto triangles = static_cast<double>(std::max(s.pictures->triangles(), 1));
  const auto affordable = static_cast<std::size_t>(kDrawnTriangles / triangles);
  s.candidates.resize(std::min(s.candidates.size(), std::max(kFewestCandidates, affordable)));
  s.looks = sideLooks(*s.snapshot);
}

CameraSearch::~CameraSearch() = default;
CameraSearch::CameraSearch(CameraSearch&&) noexcept = default;
CameraSearch& CameraSearch::operator=(CameraSearch&&) noexcept = default;

bool CameraSearch::step() {
  Impl& s = *impl_;
  if (s.figures.size() == s.candidates.size()) return false;
  const StateGuard guard(s.context.functions());
  const Camera& camera = s.candidates[s.figures.size()].camera;
  s.figures.push_back(judgeView(s.pictures->look(camera), s.width, kLookHeight, camera, s.mesh(), s.looks));
  return true;
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
    const double points = score(s.figures[i], best) + s.candidates[i].prior;
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

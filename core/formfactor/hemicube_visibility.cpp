// Hemicubes as visibility buffers: K_vq is the exact Lambert factor of receiver point v and patch q times
// whether a hemicube on the patch sees the point's surface where the point is.
//
// The four pixels around a point's direction name the surfaces that may hide it; whether one does is decided
// exactly, by where the line of sight meets its plane. So shadows have no pixels in them, and what is counted
// does not depend on how many pixels fall on a receiver. A patch that a point sees widely takes four
// hemicubes instead of one, one that emits takes sixteen, for its penumbras.
//
// Known error: visibility is that of a few points of the patch, and what is narrower than a pixel may be
// missed.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>
#include <utility>

#include "formfactor/emitter_share.h"
#include "formfactor/hemicube_choice.h"
#include "formfactor/item_elements.h"
#include "formfactor/methods.h"
#include "formfactor/pointwise.h"
#include "mesh/clip.h"
#include "mesh/grid.h"

namespace unshot {
namespace {

constexpr std::uint32_t kBufferResolution = 64, kEmitterFactor = 2, kFinestEmitterResolution = 1024;
// Radius of a patch over its distance, above which it takes four hemicubes: a square's from the middles of
// its sides is just below.
constexpr double kWideForHemicube = 1.45;
// Hemicubes of a level: 1, 4, 16.
constexpr std::size_t kHemicubeLevels = 3;

class HemicubeSight final : public Visibility {
 public:
  HemicubeSight(const FormFactorSetup& setup, std::shared_ptr<const PatchPolygons> polygons)
      : mesh_(*setup.mesh),
        polygons_(std::move(polygons)),
        elements_(mesh_),
        emitters_(mesh_),
        chosen_(chooseHemicubeView(setup)),
        seed_(setup.seed) {
    resolution_ = setup.hemicube_resolution != 0 ? setup.hemicube_resolution : kBufferResolution;
  }

  double seen(const ReceiverView& from, std::uint32_t q) override {
    begin(q);
    if (emits(q)) return share(from, q, 2);
    const double distance = glm::length(polygons_->middle(q) - from.position);
    return share(from, q, polygons_->radius(q) > kWideForHemicube * distance ? 1 : 0);
  }

  double escaping(std::uint32_t q) override {
    begin(q);
    const Picture& picture = pictures(q, 0)[0];
    if (delta_.size() != picture.element.size()) delta_ = deltaFormFactors(picture.layout);
    double out = 0;
    for (std::size_t k = 0; k < delta_.size(); ++k) out += picture.element[k] == kNone ? delta_[k] : 0;
    return std::max(out, 0.0);
  }

  std::uint64_t drawn() const override { return drawn_; }
  std::string note() const override { return chosen_.note; }

 private:
  struct Picture {
    HemicubeFrame frame;
    HemicubeFaces faces;
    HemicubeLayout layout;
    std::vector<std::uint32_t> element;  // per pixel: what it sees; kNone: nothing, kLost: in doubt
  };

  bool emits(std::uint32_t q) const {
    return emitters_.isLarge(mesh_.sides[mesh_.patch_side[q]], mesh_.patch_area[q]);
  }

  std::uint32_t emitterResolution() const {
    return std::max(resolution_, std::min(kEmitterFactor * resolution_, kFinestEmitterResolution));
  }

  void begin(std::uint32_t q) {
    if (q == patch_) return;
    patch_ = q;
    for (std::vector<Picture>& level : pictures_) level.clear();
  }

  const std::vector<Picture>& pictures(std::uint32_t q, std::size_t level) {
    std::vector<Picture>& out = pictures_[level];
    if (!out.empty()) return out;
    polygons_->spread(q, 1u << (2 * level), points_);
    for (const glm::dvec3& point : points_) out.push_back(pictureFrom(q, point));
    return out;
  }

  // Of the sides that make the patch, the one that the point lies on.
  const Side& sideAt(std::uint32_t q, const glm::dvec3& point) const {
    const auto parts = mesh_.partsOf(q);
    const auto distance = [&](std::uint32_t part) {
      const Surface& surface = mesh_.surfaces[mesh_.sides[mesh_.patch_parts[part].side].surface];
      const glm::dvec2 at = surface.chart(point);
      return glm::distance(point, surface.point(glm::clamp(at, glm::dvec2(0.0), surface.extent)));
    };
    const std::uint32_t nearest = *std::min_element(
        parts.begin(), parts.end(), [&](auto a, auto b) { return distance(a) < distance(b); });
    return mesh_.sides[mesh_.patch_parts[nearest].side];
  }

  Picture pictureFrom(std::uint32_t q, const glm::dvec3& point) {
    const Side& side = sideAt(q, point);
    const Surface& surface = mesh_.surfaces[side.surface];
    const HemicubeFrame frame = turnedHemicube(mesh_, side.surface, side, surface.chart(point),
                                               1e-3 * std::sqrt(mesh_.patch_area[q]), seed_);
    Picture out{frame, HemicubeFaces(frame), {emits(q) ? emitterResolution() : resolution_}, {}};
    const HemicubeView::Result seen = chosen_.view->look(out.frame, out.layout);
    ++drawn_;
    out.element.resize(seen.items.size());
    for (std::size_t k = 0; k < out.element.size(); ++k)
      out.element[k] = elements_.at(seen.items, out.layout, k);
    return out;
  }

  // The mean over the hemicubes of this level, each by its own kernel.
  double share(const ReceiverView& from, std::uint32_t q, std::size_t level) {
    double all = 0, visible = 0, seeing = 0;
    const std::vector<Picture>& taken = pictures(q, level);
    for (const Picture& picture : taken) {
      const glm::dvec3 to = picture.frame.eye - from.position;
      const double square = glm::dot(to, to), near = std::max(glm::dot(to, from.normal), 0.0),
                   far = std::max(-glm::dot(to, picture.frame.normal), 0.0);
      const double kernel = near * far / (square * square);  // 0 below the horizon: not hidden, not there
      const bool sees_it = sees(picture, from);
      all += kernel;
      visible += sees_it ? kernel : 0;
      seeing += sees_it;
    }
    // Where all are below the horizon, what is above it lies beside them.
    return all > 0 ? visible / all : seeing / static_cast<double>(taken.size());
  }

  // Whether the surface of an element stands between the eye and the point.
  bool hides(std::uint32_t element, const glm::dvec3& eye, const ReceiverView& from) const {
    const Side& side = mesh_.sides[mesh_.element_side[element]];
    if (side.surface == mesh_.sides[from.side].surface) return false;
    const Surface& surface = mesh_.surfaces[side.surface];
    const double before = glm::dot(surface.normal, eye - surface.origin),
                 behind = glm::dot(surface.normal, from.position - surface.origin);
    if (before * behind >= 0) return false;
    const glm::dvec3 crossing = eye + before / (before - behind) * (from.position - eye);
    return holds(surface, surface.chart(crossing));
  }

  // Whether the surface has area there.
  bool holds(const Surface& surface, const glm::dvec2& uv) const {
    if (uv.x < 0 || uv.y < 0 || uv.x > surface.extent.x || uv.y > surface.extent.y) return false;
    const Range pieces = mesh_.cells[cellAt(surface, uv)].pieces;
    for (std::uint32_t p = pieces.first; p < pieces.end(); ++p) {
      if (contains(mesh_.cornersOf(mesh_.pieces[p]), uv)) return true;
    }
    return false;
  }

  bool sees(const Picture& picture, const ReceiverView& from) const {
    const glm::dvec3 direction = from.position - picture.frame.eye;
    const HemicubeFaces& faces = picture.faces;
    std::uint32_t face = 0;
    double forward = 0;
    for (std::uint32_t f = 0; f < 5; ++f) {
      const double along = glm::dot(direction, faces.forward[f]);
      if (along <= forward) continue;
      forward = along;
      face = f;
    }
    if (forward <= 0) return false;
    const std::uint32_t n = picture.layout.resolution, rows = picture.layout.faceHeight(face);
    const double x = glm::dot(direction, glm::cross(faces.forward[face], faces.up[face])) / forward,
                 y = glm::dot(direction, faces.up[face]) / forward + (face == 0 ? 1 : 0);
    const auto pixel = [n](double at, std::uint32_t count) {
      return static_cast<std::uint32_t>(std::clamp(at * n / 2 - 0.5, 0.0, count - 2.0));
    };
    const std::size_t first =
        std::size_t{picture.layout.faceRow(face) + pixel(y, rows)} * n + pixel(x + 1, n);
    // Through closed walls light leaks where the corner of one falls between four pixels: what they see is of
    // another room then.
    bool same_air = false;
    for (const std::size_t k : {first, first + 1, first + n, first + n + 1}) {
      const std::uint32_t element = picture.element[k];
      if (element == kNone) same_air = true;
      if (element == kNone || element == ItemElements::kLost) continue;
      same_air = same_air || mesh_.patch_air[mesh_.element_patch[element]] == mesh_.patch_air[from.patch];
      if (hides(element, picture.frame.eye, from)) return false;
    }
    return same_air;
  }

  const Mesh& mesh_;
  std::shared_ptr<const PatchPolygons> polygons_;
  ItemElements elements_;
  EmitterShare emitters_;
  ChosenHemicubeView chosen_;
  std::uint64_t seed_;
  std::uint32_t resolution_ = 0;
  std::uint32_t patch_ = kNone;  // that the pictures are of
  std::array<std::vector<Picture>, kHemicubeLevels> pictures_;
  std::vector<glm::dvec3> points_;
  std::vector<double> delta_;  // of the last layout that was asked for
  std::uint64_t drawn_ = 0;
};

}  // namespace

std::unique_ptr<FormFactorMethod> makeHemicubeVisibility(const FormFactorSetup& setup) {
  auto polygons = std::make_shared<const PatchPolygons>(*setup.mesh, setup.cancel);
  auto visibility = std::make_unique<HemicubeSight>(setup, polygons);
  return std::make_unique<Pointwise>(setup, std::move(polygons), std::move(visibility));
}

}  // namespace unshot

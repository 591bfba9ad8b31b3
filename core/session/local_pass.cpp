#include "session/local_pass.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "base/clock.h"
#include "formfactor/piece_polygons.h"

namespace unshot {
namespace {

// A patch, or an element of the base, is near within so many of its radii. On the Cornell box of 600 elements
// twice as many lower the error from 2.2 to 2.0 %, for five times the work; half as many leave 2.2 %.
constexpr double kNearRadii = 3;
// One of several surfaces has many elements, which are all looked at: on teapot_box half as many again take
// twice as many looks and leave the error as it is (1.1 %), without any it is 1.4 %.
constexpr double kNearJoined = 1;
constexpr double kPassSeconds = 4e-3;  // of an advance
// Looks that are kept for the next pass, 24 bytes each.
constexpr std::size_t kMostKept = 2'000'000;
// Patches that each thread looks for before their light is added up.
constexpr std::size_t kAhead = 4;

std::vector<glm::dvec3> placesOf(const Receivers& receivers, const Range& range) {
  std::vector<glm::dvec3> out;
  for (std::uint32_t v = range.first; v < range.end(); ++v) {
    const auto views = receivers.viewsOf(v);
    out.push_back(views.empty() ? glm::dvec3(0.0) : views[0].position);
  }
  return out;
}

// Times SceneRays::lift: heights that rays tell from none.
constexpr double kHeightsTold = 10;

// Where to look for the polygon: its centre or, where that is below the view's horizon, a place half as high
// as its highest corner; nothing where that is no height.
std::optional<glm::dvec3> placeAbove(const FactorPolygon& polygon, const ReceiverView& view, double lift) {
  const auto height = [&](const glm::dvec3& p) { return glm::dot(p - view.position, view.normal); };
  const glm::dvec3& centre = polygon.centre();
  const double low = height(centre);
  if (low > 0) return centre;
  const glm::dvec3* top = &centre;
  for (const glm::dvec3& corner : polygon.corners()) top = height(corner) > height(*top) ? &corner : top;
  const double high = height(*top);
  if (high < kHeightsTold * lift) return std::nullopt;
  return glm::mix(centre, *top, (high / 2 - low) / (high - low));
}

}  // namespace

LocalPass::LocalPass(const Mesh& mesh, const Receivers& receivers, bool occlusion,
                     std::shared_ptr<Workers> workers, std::shared_ptr<const MeshRays> rays)
    : mesh_(mesh),
      receivers_(receivers),
      occlusion_(occlusion),
      rays_(std::move(rays)),
      first_receiver_(receivers.reachedBy(false).first),
      workers_(std::move(workers)),
      hands_(workers_ ? workers_->count() : 1) {}

void LocalPass::findPlaces() {
  polygons_.emplace(mesh_);
  if (!occlusion_) {
    rays_.reset();
  } else if (!rays_) {
    rays_ = std::make_shared<const MeshRays>(mesh_);
  }
  places_ = placesOf(receivers_, receivers_.reachedBy(false));
  tree_.emplace(places_);
  makeGroups();
  looks_.resize(mesh_.patch_count);
}

void LocalPass::makeGroups() {
  const Mesh& base = mesh_.base ? *mesh_.base : mesh_;
  groups_.resize(base.element_count);
  groups_of_patch_.resize(base.patch_count);
  for (std::uint32_t e = 0; e < base.element_count; ++e) groups_of_patch_[base.element_patch[e]].push_back(e);
  forEachPiece(base, [&](const Side& side, std::uint32_t e, FactorPolygon polygon) {
    Group& group = groups_[e];
    group.middle = base.shapes[base.surfaces[side.surface].elements.first + e - side.first_element].centre;
    for (const glm::dvec3& corner : polygon.corners())
      group.radius = std::max(group.radius, glm::distance(corner, group.middle));
    group.whole.push_back({std::move(polygon), e});
  });
  forEachPiece(mesh_, [&](const Side&, std::uint32_t e, FactorPolygon polygon) {
    groups_[mesh_.base ? mesh_.element_from_base[e] : e].parts.push_back({std::move(polygon), e});
  });
}

void LocalPass::begin(const RadiosityState& state, const MeshField& irradiance) {
  if (!polygons_) findPlaces();
  element_light_.resize(mesh_.element_count);
  group_light_.assign(groups_.size(), glm::dvec3(0.0));
  std::vector<double> area(groups_.size(), 0.0);
  for (std::uint32_t e = 0; e < mesh_.element_count; ++e) {
    const std::uint32_t group = mesh_.base ? mesh_.element_from_base[e] : e;
    element_light_[e] = state.reflectance()[mesh_.element_patch[e]] * glm::dvec3(irradiance.elements[e]);
    group_light_[group] += mesh_.element_area[e] * element_light_[e];
    area[group] += mesh_.element_area[e];
  }
  for (std::size_t g = 0; g < groups_.size(); ++g) group_light_[g] /= std::max(area[g], 1e-300);
  patch_light_ = state.shot();
  std::vector<glm::dvec3> light(mesh_.vertices.size());
  for (std::size_t v = 0; v < light.size(); ++v)
    light[v] = receivers_.reflectance[v] * glm::dvec3(irradiance.vertices[v]);
  slopes_ = ElementSlopes(mesh_, light);
  sum_.assign(receivers_.size(), glm::dvec3(0.0));
  next_ = found_until_ = 0;
}

void LocalPass::advance(Transport& transport) {
  const double until = wallSeconds() + kPassSeconds;
  for (; running() && wallSeconds() < until; ++next_) {
    // What emitters reflect goes the way of their emission, along columns that are exact already.
    if (mesh_.emits(next_) || !transport.isKept(next_)) continue;
    if (next_ >= found_until_) findAhead(transport);
    gather(next_, transport.column(next_), transport.closure());
  }
  if (!running()) irradiance_ = std::move(sum_);
}

// What the next patches bring, each by a thread, as long as there is room for it.
void LocalPass::findAhead(const Transport& transport) {
  if (!workers_ || workers_->count() == 1) return;
  std::vector<std::uint32_t> patches;
  for (found_until_ = next_; found_until_ < mesh_.patch_count && kept_ < kMostKept; ++found_until_) {
    const Column* column = mesh_.emits(found_until_) ? nullptr : transport.kept(found_until_);
    if (!column || !column->receiver.empty() || looks_[found_until_].found) continue;
    if (patches.size() == kAhead * workers_->count()) break;
    patches.push_back(found_until_);
  }
  workers_->run(patches.size(), [&](std::size_t k, unsigned worker) {
    find(patches[k], hands_[worker]);
    looks_[patches[k]] = hands_[worker].found;
  });
  // What is kept is what one thread would have kept.
  for (const std::uint32_t q : patches) {
    if (kept_ < kMostKept) {
      kept_ += looks_[q].looks.size();
    } else {
      looks_[q] = {};
    }
  }
}

void LocalPass::gather(std::uint32_t q, const Column& column, const RowClosure& closure) {
  if (!column.receiver.empty()) return;
  const auto scale = [&](std::uint32_t v) {
    return closure.scale.empty() || closure.exact[q] ? 1.0 : static_cast<double>(closure.scale[v]);
  };
  const Looks* looks = &looks_[q];
  if (!looks->found) {
    find(q, hands_[0]);
    if (kept_ < kMostKept) {
      looks_[q] = hands_[0].found;
      kept_ += looks->looks.size();
    } else {
      looks = &hands_[0].found;
    }
  }
  std::uint32_t next = 0;
  for (const Near& near : looks->near) {
    glm::dvec3 light(0.0);
    for (; next < near.end; ++next) light += lightOf(looks->looks[next]);
    const std::uint32_t v = near.receiver;
    sum_[v] += scale(v) * light - static_cast<double>(column.k[v - column.first]) * patch_light_[q];
  }
}

glm::dvec3 LocalPass::lightOf(const Look& look) const {
  const double factor = static_cast<double>(look.factor);
  if (look.whole) return factor * group_light_[look.of];
  const glm::dvec3 more = slopes_.excess(look.of, glm::dvec3(look.moment));
  return glm::max(factor * element_light_[look.of] + more, glm::dvec3(0.0));
}

void LocalPass::find(std::uint32_t q, Hand& hand) const {
  Looks& out = hand.found;
  out.found = true;
  out.near.clear();
  out.looks.clear();
  const glm::dvec3& middle = polygons_->middle(q);
  const double near_radii = mesh_.joined(q) ? kNearJoined : kNearRadii;
  tree_->nearSegment(middle, middle, near_radii * polygons_->radius(q), [&](std::uint32_t place) {
    const std::uint32_t v = first_receiver_ + place;
    bool near = false;
    for (const ReceiverView& view : receivers_.viewsOf(v)) near |= look(view, q, out.looks, hand.scratch);
    if (near) out.near.push_back({v, static_cast<std::uint32_t>(out.looks.size())});
  });
}

// Adds what the view sees of the patch's elements. Returns whether there is anything of it to be seen, but
// for what occludes.
bool LocalPass::look(const ReceiverView& view, std::uint32_t q, std::vector<Look>& out,
                     std::vector<glm::dvec3>& scratch) const {
  if (mesh_.sides[view.side].surface == polygons_->surface(q) || mesh_.inOtherRooms(view.side, q) ||
      !polygons_->faces(q, view.position, view.normal))
    return false;
  const glm::dvec3& normal = mesh_.sides[mesh_.patch_side[q]].normal;
  const glm::dvec3 eye = rays_ ? rays_->rays().lifted(view.position, view.normal) : view.position;
  // What rays have to decide on, so many together.
  std::array<glm::dvec3, SceneRays::kTogether> ends;
  std::array<Look, SceneRays::kTogether> found;
  std::size_t count = 0;
  const auto decide = [&] {
    if (count == 0) return;
    const std::uint32_t hidden = rays_->occluded(eye, {ends.data(), count});
    for (std::size_t k = 0; k < count; ++k) {
      if (!(hidden >> k & 1)) out.push_back(found[k]);
    }
    count = 0;
  };
  const auto add = [&](const Tile& tile, const Look& look) {
    if (!rays_) {
      out.push_back(look);
      return;
    }
    const std::optional<glm::dvec3> place = placeAbove(tile.polygon, view, rays_->rays().lift());
    if (!place) return;
    ends[count] = rays_->rays().lifted(*place, normal);
    found[count++] = look;
    if (count == ends.size()) decide();
  };
  for (const std::uint32_t g : groups_of_patch_[q]) {
    const Group& group = groups_[g];
    const bool whole = glm::distance(view.position, group.middle) > kNearRadii * group.radius;
    for (const Tile& tile : whole ? group.whole : group.parts) {
      const double factor = tile.polygon.quick(view.position, view.normal, scratch);
      if (factor <= 0) continue;
      Look look{whole ? g : tile.element, whole, static_cast<float>(view.weight * factor)};
      if (!whole)
        look.moment =
            view.weight * slopes_.moment(view, tile.element, tile.polygon.corners(), factor, scratch);
      add(tile, look);
    }
  }
  decide();
  return true;
}

}  // namespace unshot

// The hemicube method, pixels counted: F from a patch to every element at once (Cohen and Greenberg 1985).
//
// A picture is taken from one point, as if all of the patch's light left there. Its error grows with the
// patch's size over the distance to what it sees, so a patch is split, node by node of its tree and below,
// while a stated share of its view is nearer than a stated multiple of its size, down to a floor: next to an
// edge that two surfaces share no refinement of a single sample helps. Emitters are split further, while a
// part holds a fair share of all emitted power, since everything sees the edges of its shadow. Each picture
// is turned about the normal by its own angle, so that the pixels' grid leaves no pattern.
//
// Known error: an element smaller than a pixel gets nothing from one picture and too much from another; what
// is left next to shared edges is a few percent at the floor (tests/analytic says how much).
#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <utility>

#include "formfactor/emitter_share.h"
#include "formfactor/hemicube_choice.h"
#include "formfactor/item_elements.h"
#include "formfactor/methods.h"
#include "formfactor/patch_groups.h"
#include "formfactor/regions.h"

namespace unshot {
namespace {

// A region is split while more than kNearShare of its view is nearer than its size / fraction.
constexpr double kNearShare = 0.05;
constexpr double kSplitFraction = 0.75;
constexpr double kEmitterSplitFraction = 0.125;
// The floor: parts are not smaller than about half an element, or than this share of the scene's size where
// elements are coarse. Small patches of a fine scene are not split at all.
constexpr double kFloorShare = 1.0 / 32;
// However coarse a patch is, its column takes no more than a few hundred pictures: steps stay short.
constexpr int kMostSplits = 4;
// Pixels along the top face. A converged solution rests on thousands of pictures, each turned by its own
// angle, so 64 give the same error as 128 on the Cornell box (1.3 % at 10,000 elements) in half the time. The
// few that show the emitters' light and shadows are finer by a factor: nothing averages their noise out.
constexpr std::uint32_t kResolution = 64;
constexpr std::uint32_t kEmitterFactor = 4;
constexpr std::uint32_t kTracedEmitterFactor = 2;  // a ray costs more than a drawn pixel
constexpr std::uint32_t kFinestEmitterResolution = 1024;

// Patches that may shoot as one, and what their pictures may take while the others of a group may come.
constexpr std::uint32_t kGroupPatches = 16;
constexpr std::size_t kGroupBytes = std::size_t{64} << 20;

// A group does not shoot as one where more than this share of its view is nearer than a part of its size:
// between sheets that lie close together light arrives opposite to where it left.
constexpr double kFacedShare = 0.2;
constexpr double kFacedFraction = 4;

// What a picture for a group of patches showed: shares of its light.
struct GroupView {
  std::vector<std::pair<std::uint32_t, float>> received;  // element and share, ascending
  double escape = 0;
  bool faced = false;  // nothing else is kept then
};

class Hemicube final : public FormFactorMethod {
 public:
  Hemicube(const FormFactorSetup& setup)
      : mesh_(*setup.mesh),
        groups_(mesh_, kGroupPatches),
        elements_(mesh_),
        emitters_(mesh_),
        seed_(setup.seed) {
    resolution_ = setup.hemicube_resolution != 0 ? setup.hemicube_resolution : kResolution;
    chooseView(setup);
    floor_ = std::min(mesh_.element_size / 2, kFloorShare * glm::length(mesh_.bounds_max - mesh_.bounds_min));
    received_.assign(mesh_.element_count, 0.0);
    touched_.assign(mesh_.element_count / 64 + 1, 0);
  }

  ReceiverKind receiverKind() const override { return ReceiverKind::kElements; }
  std::uint64_t drawn() const override { return drawn_; }
  std::string note() const override { return note_; }

  Column column(std::uint32_t q) override { return shotBy(q, false); }

  // One picture for the whole patch, however near its view is, or for all patches of its group. On the
  // Cornell box at 10,000 elements the solution of group drafts is 6 % off that of full columns, in a tenth
  // of the time; that of single pictures 1.1 %, in 0.4 of it.
  Column draft(std::uint32_t q, ColumnQuality wanted) override {
    if (mesh_.emits(q)) return shotBy(q, false);
    if (wanted == ColumnQuality::kGroup && groups_.members(groups_.of(q)).size() > 1) {
      if (const GroupView& view = groupView(groups_.of(q)); !view.faced) return shotByGroup(q, view);
    }
    return shotBy(q, true);
  }

  Row row(std::uint32_t v) override {
    const Side& side = mesh_.sides[mesh_.element_side[v]];
    begin();
    const ElementShape& shape =
        mesh_.shapes[mesh_.surfaces[side.surface].elements.first + v - side.first_element];
    Region point;
    point.side = mesh_.element_side[v];
    point.surface = side.surface;
    point.area = mesh_.element_area[v];
    drafting_ = false;
    point.sample = mesh_.surfaces[side.surface].chart(shape.centre);
    shoot(point, 0, 1 / point.area);
    std::vector<double> per_patch(mesh_.patch_count, 0.0);
    takeReceived([&](std::uint32_t e, double f) { per_patch[mesh_.element_patch[e]] += f; });
    Row out;
    double sum = 0;
    for (std::uint32_t q = 0; q < mesh_.patch_count; ++q) {
      if (per_patch[q] == 0) continue;
      out.source.push_back(q);
      out.k.push_back(static_cast<float>(per_patch[q]));
      sum += static_cast<double>(out.k.back());
    }
    out.escape = 1 - sum;
    return out;
  }

 private:
  Column shotBy(std::uint32_t q, bool draft) {
    begin();
    const Region whole = regionOfPatch(mesh_, q);
    drafting_ = draft;
    cut_short_ = false;
    shoot(whole, draft ? 0 : kMostSplits, 1 / whole.area);
    Column out;
    if (cut_short_) out.quality = ColumnQuality::kOnePoint;
    takeReceived([&](std::uint32_t e, double f) {
      out.receiver.push_back(e);
      out.k.push_back(static_cast<float>(f * mesh_.patch_area[q] / mesh_.element_area[e]));
    });
    out.escape = escape_;
    closeColumn(q, out);
    return out;
  }

  // The shares of the group's picture, times the patch's area.
  Column shotByGroup(std::uint32_t q, const GroupView& view) {
    Column out;
    out.quality = ColumnQuality::kGroup;
    out.at_hand = !group_is_new_;
    for (const auto& [element, share] : view.received) {
      out.receiver.push_back(element);
      out.k.push_back(
          static_cast<float>(static_cast<double>(share) * mesh_.patch_area[q] / mesh_.element_area[element]));
    }
    out.escape = view.escape;
    closeColumn(q, out);
    return out;
  }

  const GroupView& groupView(std::uint32_t group) {
    group_is_new_ = !group_views_.contains(group);
    if (group_is_new_) takeGroupView(group);
    return group_views_.at(group);
  }

  void takeGroupView(std::uint32_t group) {
    begin();
    const Region whole = groups_.region(group);
    drafting_ = true;
    faced_share_ = 0;
    shoot(whole, 0, 1 / whole.area);
    GroupView view;
    view.faced = faced_share_ > kFacedShare;
    takeReceived([&](std::uint32_t e, double f) {
      if (!view.faced) view.received.emplace_back(e, static_cast<float>(f));
    });
    view.escape = escape_;
    const std::size_t bytes = view.received.size() * sizeof(view.received[0]);
    if (group_bytes_ + bytes > kGroupBytes) {
      group_views_.clear();
      group_bytes_ = 0;
    }
    group_bytes_ += bytes;
    group_views_.emplace(group, std::move(view));
  }

  void chooseView(const FormFactorSetup& setup) {
    ChosenHemicubeView chosen = chooseHemicubeView(setup);
    view_ = std::move(chosen.view);
    note_ = std::move(chosen.note);
    emitter_resolution_ = emitterResolution(chosen.traced ? kTracedEmitterFactor : kEmitterFactor);
  }

  std::uint32_t emitterResolution(std::uint32_t factor) const {
    return std::max(resolution_, std::min(factor * resolution_, kFinestEmitterResolution));
  }

  void begin() { escape_ = 0; }

  template <class F>
  void takeReceived(F&& f) {
    for (std::size_t word = 0; word < touched_.size(); ++word) {
      for (std::uint64_t bits = std::exchange(touched_[word], 0); bits != 0; bits &= bits - 1) {
        const auto e =
            static_cast<std::uint32_t>(64 * word) + static_cast<std::uint32_t>(std::countr_zero(bits));
        f(e, received_[e]);
        received_[e] = 0;
      }
    }
  }

  // Rounding of the kept floats goes to the defect, so that energy adds up to the last digit kept.
  void closeColumn(std::uint32_t q, Column& column) const {
    double sum = 0;
    for (std::size_t i = 0; i < column.k.size(); ++i) {
      sum += static_cast<double>(column.k[i]) * mesh_.element_area[column.receiver[i]] / mesh_.patch_area[q];
    }
    column.defect = 1 - column.escape - sum;
    if (column.receiver.size() * 2 <= mesh_.element_count) {
      column.receiver.shrink_to_fit();
      column.k.shrink_to_fit();
      return;
    }
    std::vector<float> dense(mesh_.element_count, 0.0f);
    for (std::size_t i = 0; i < column.k.size(); ++i) dense[column.receiver[i]] = column.k[i];
    column.k = std::move(dense);
    column.receiver = {};
  }

  const std::vector<double>& deltas(HemicubeLayout layout) {
    for (const auto& [resolution, values] : deltas_) {
      if (resolution == layout.resolution) return values;
    }
    return deltas_.emplace_back(layout.resolution, deltaFormFactors(layout)).second;
  }

  HemicubeFrame frameOf(const Region& region, const Side& side) const {
    return turnedHemicube(mesh_, region.surface, side, region.sample, 1e-3 * std::sqrt(region.area), seed_);
  }

  // Shoots from the region or, where its view is too near for one point, from its parts. Adds share = area *
  // per_area in all.
  void shoot(const Region& region, int splits, double per_area) {
    const Side& side = mesh_.sides[region.side];
    const bool emits = emitters_.isLarge(side, region.area);
    const HemicubeLayout layout{emits ? emitter_resolution_ : resolution_};
    const std::vector<double>& delta = deltas(layout);
    const HemicubeView::Result seen = view_->look(frameOf(region, side), layout);
    ++drawn_;
    if (std::sqrt(region.area) > 1.4 * floor_ && (splits > 0 || drafting_)) {
      const double limit =
          std::sqrt(region.area) / (emits ? kEmitterSplitFraction : kSplitFraction) / seen.far_distance;
      const double faced = std::sqrt(region.area) / kFacedFraction / seen.far_distance;
      double near = 0;
      for (std::size_t k = 0; k < delta.size(); ++k) {
        near += static_cast<double>(seen.distance[k]) < limit ? delta[k] : 0.0;
        faced_share_ += drafting_ && static_cast<double>(seen.distance[k]) < faced ? delta[k] : 0.0;
      }
      if (near > kNearShare && splits == 0) {
        cut_short_ = true;
      } else if (near > kNearShare) {
        for (const Region& part : partsOf(mesh_, region)) shoot(part, splits - 1, per_area);
        return;
      }
    }
    count(seen, delta, layout, region.area * per_area);
  }

  void count(const HemicubeView::Result& seen, const std::vector<double>& delta, HemicubeLayout layout,
             double share) {
    for (std::size_t k = 0; k < delta.size(); ++k) {
      const std::uint32_t element = elements_.at(seen.items, layout, k);
      if (element == kNone) {
        escape_ += share * delta[k];
      } else if (element != ItemElements::kLost) {
        touched_[element / 64] |= std::uint64_t{1} << element % 64;
        received_[element] += share * delta[k];
      }
    }
  }

  const Mesh& mesh_;
  PatchGroups groups_;
  ItemElements elements_;
  EmitterShare emitters_;
  std::unordered_map<std::uint32_t, GroupView> group_views_;
  std::size_t group_bytes_ = 0;
  std::unique_ptr<HemicubeView> view_;
  std::string note_;
  std::uint64_t seed_;
  double floor_ = 0;  // [m]
  std::uint32_t resolution_ = 0, emitter_resolution_ = 0;
  std::vector<std::pair<std::uint32_t, std::vector<double>>> deltas_;
  std::vector<double> received_;        // per element, of the column in work
  std::vector<std::uint64_t> touched_;  // a bit per element: ascending order without sorting
  double escape_ = 0;
  bool drafting_ = false, cut_short_ = false;  // whether a split is left out, and whether one was
  bool group_is_new_ = false;                  // the view of it was taken just now
  double faced_share_ = 0;                     // of the view of a draft: what is near (kFacedFraction)
  std::uint64_t drawn_ = 0;
};

}  // namespace

std::unique_ptr<FormFactorMethod> makeHemicube(const FormFactorSetup& setup) {
  return std::make_unique<Hemicube>(setup);
}

}  // namespace unshot

#include "mesh/reach.h"

#include <algorithm>
#include <unordered_set>

#include "mesh/shells.h"

namespace unshot {
namespace {

// A point off a side is so many weld distances away: beyond what counts as lying in its plane. A second one,
// nearer, tells what stands between.
constexpr double kOff = 4, kNear = 1;
// Points on an emitter that may be in several places.
constexpr int kMixedPoints = 16;

class Reach {
 public:
  Reach(const Mesh& mesh, const std::vector<SurfaceEdge>& edges, std::span<const Touch> touches,
        Shells& shells, double weld_distance)
      : shells_(shells),
        weld_distance_(weld_distance),
        stands_on_(mesh.surfaces.size()),
        lit_(2 * mesh.surfaces.size(), 0),
        shell_lit_(lit_.size(), 0),
        shell_known_(lit_.size(), 0) {
    for (const Touch& t : touches) {
      for (std::uint32_t use = t.edge;
           use < edges.size() && edges[use].a == edges[t.edge].a && edges[use].b == edges[t.edge].b; ++use)
        stands_on_[t.surface].push_back(edges[use].surface);
    }
  }

  /// Returns whether it can be told.
  bool findLight(std::span<const char> emits, const CancelToken& cancel) {
    for (std::uint32_t side = 0; side < emits.size(); ++side) {
      cancel.check();
      for (int k = 0; emits[side] && k < (isMixed(side) ? kMixedPoints : 1); ++k) {
        for (const double off : {kOff, kNear}) {
          const auto place = shells_.placeOf(side, off * weld_distance_, k);
          if (!place) return false;
          light_.insert(*place);
        }
      }
    }
    for (std::uint32_t side = 0; side < lit_.size(); ++side) {
      cancel.check();
      lit_[side] = emits[side] || seesLight(side, kOff) || seesLight(side, kNear);
      const std::uint32_t shell = shells_.of(side);
      shell_lit_[shell] |= lit_[side];
      shell_known_[shell] |= static_cast<char>(!isMixed(side));
    }
    return true;
  }

  /// Lights sides that may be in several places from what is around them: the rest of their shell, and what
  /// stands on them. Where all of that may be in several places too, on the safe side.
  void lightMixed() {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::uint32_t side = 0; side < lit_.size(); ++side) {
        if (lit_[side] || !isMixed(side)) continue;
        bool light = shell_lit_[shells_.of(side)] != 0, known = shell_known_[shells_.of(side)] != 0;
        for (const std::uint32_t s : stands_on_[side / 2]) {
          for (const std::uint32_t shell : {shells_.of(2 * s), shells_.of(2 * s + 1)}) {
            light = light || shell_lit_[shell];
            known = known || shell_known_[shell];
          }
        }
        if (!light && known) continue;
        lit_[side] = shell_lit_[shells_.of(side)] = 1;
        changed = true;
      }
    }
  }

  std::vector<char> take() { return std::move(lit_); }

 private:
  bool isMixed(std::uint32_t side) const { return !stands_on_[side / 2].empty(); }
  bool seesLight(std::uint32_t side, double off) {
    const auto place = shells_.placeOf(side, off * weld_distance_, 0);
    return !place || light_.count(*place) > 0;
  }

  Shells& shells_;
  double weld_distance_;
  std::vector<std::vector<std::uint32_t>> stands_on_;  // surfaces, of surfaces
  std::unordered_set<Shells::Place> light_;
  std::vector<char> lit_;                      // of sides
  std::vector<char> shell_lit_, shell_known_;  // whether one of its sides is lit, or surely in one place
};

}  // namespace

std::vector<char> findReach(const Mesh& mesh, const std::vector<SurfaceEdge>& edges,
                            std::span<const Crossing> crossings, std::span<const char> emits,
                            double weld_distance, const CancelToken& cancel) {
  std::vector<char> everywhere(2 * mesh.surfaces.size(), 1);
  if (std::find(emits.begin(), emits.end(), 1) == emits.end()) return everywhere;
  const std::vector<Touch> touches = findTouches(mesh, edges, 2 * kOff * weld_distance, cancel);
  Shells shells(mesh, edges, crossings, touches, weld_distance, cancel);
  if (!shells.separate()) return everywhere;
  Reach reach(mesh, edges, touches, shells, weld_distance);
  if (!reach.findLight(emits, cancel)) return everywhere;
  reach.lightMixed();
  return reach.take();
}

}  // namespace unshot

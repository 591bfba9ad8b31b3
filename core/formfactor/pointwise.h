// Form factors at points: K_vq is the Lambert factor of receiver point v and patch q (exact where q emits
// much, else FactorPolygon::quick) times the share of the patch that v sees, whoever finds that out.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/cancel.h"
#include "formfactor/methods.h"
#include "formfactor/patch_polygons.h"

namespace unshot {

/// What stands between points and patches.
class Visibility {
 public:
  virtual ~Visibility() = default;
  /// The share of the patch's Lambert factor that the point sees, 0 to 1; called only where the factor
  /// without occlusion is above 0.
  virtual double seen(const ReceiverView& from, std::uint32_t q) = 0;
  /// The same from several points, one share for each.
  virtual void seenFrom(std::span<const ReceiverView* const> points, std::uint32_t q,
                        std::span<double> shares) {
    for (std::size_t k = 0; k < points.size(); ++k) shares[k] = seen(*points[k], q);
  }
  /// Another that says the same, for another thread; null: this one is all there is.
  virtual std::unique_ptr<Visibility> another() const { return nullptr; }
  /// The share of patch q's light that meets no surface.
  virtual double escaping(std::uint32_t q) = 0;
  // See FormFactorMethod.
  virtual std::uint64_t drawn() const { return 0; }
  virtual std::string note() const { return {}; }
};

class Pointwise final : public FormFactorMethod {
 public:
  /// The setup's mesh must outlive it. Without a visibility nothing stands between any two points.
  Pointwise(const FormFactorSetup& setup, std::shared_ptr<const PatchPolygons> polygons,
            std::unique_ptr<Visibility> visibility);

  ReceiverKind receiverKind() const override { return ReceiverKind::kVertices; }
  Column column(std::uint32_t q) override;
  Row row(std::uint32_t v) override;
  std::uint64_t drawn() const override { return occludes_ ? hands_[0].visibility->drawn() : 0; }
  std::string note() const override { return occludes_ ? hands_[0].visibility->note() : std::string(); }

 private:
  // Views that look at a patch together.
  struct Looks {
    static constexpr std::size_t kMost = 16;
    std::array<const ReceiverView*, kMost> views;
    std::array<std::uint32_t, kMost> receivers;
    std::array<double, kMost> unoccluded;  // weight times Lambert factor
    std::size_t count = 0;
  };

  // What one thread has for itself.
  struct Hand {
    std::unique_ptr<Visibility> visibility;  // null where nothing occludes
    std::vector<glm::dvec3> scratch;
  };

  double factor(std::uint32_t v, std::uint32_t q);
  double lambert(const ReceiverView& from, std::uint32_t q, Hand& hand) const;
  void decide(Looks& looks, std::uint32_t q, Hand& hand);
  void addSeen(std::uint32_t q, const Range& receivers, std::uint32_t first, Hand& hand);
  double escapeOf(std::uint32_t q);
  double escapeAlongRows(std::uint32_t q);
  void groupShares();

  const Mesh& mesh_;
  std::shared_ptr<const PatchPolygons> polygons_;
  std::shared_ptr<Workers> workers_;  // null: one hand does all
  bool occludes_;
  std::vector<Hand> hands_;  // one per worker
  std::shared_ptr<const Receivers> receivers_;
  // One per patch: without occlusion all factors are exact; beside what rays leave open those of patches that
  // emit little or nothing need not be.
  std::vector<char> exact_;
  std::vector<double> sums_;
  std::vector<PatchShare> by_patch_;
  std::vector<std::uint32_t> share_start_;
  std::vector<double> row_escape_;  // per receiver; below 0: not known yet
};

}  // namespace unshot

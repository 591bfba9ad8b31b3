// What a patch sees through the solver's kind of hemicube, traced with rays on a thread of its own, so that
// neither the window nor the solver waits for it.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "base/cancel.h"
#include "base/error.h"
#include "formfactor/delta_form_factors.h"
#include "mesh/mesh.h"

namespace unshot {

/// One hemicube on the middle of a patch, turned as the solver turns it.
struct HemicubeLook {
  std::shared_ptr<const Mesh> mesh;
  std::uint32_t patch = 0;
  HemicubeLayout layout{0};
  std::vector<std::uint32_t> elements;               ///< seen, one per pixel of the layout; kNone: nothing
  std::shared_ptr<const std::vector<double>> delta;  ///< delta form factors, one per pixel
  std::shared_ptr<const std::vector<std::uint8_t>> colours;  ///< of patches (render/patch_colours.h)

  std::uint32_t patchAt(std::size_t pixel) const {
    return elements[pixel] == kNone ? kNone : mesh->element_patch[elements[pixel]];
  }
  /// Delta form factors of the pixels that see each patch, summed: one per patch, and last what escapes.
  std::vector<double> shares() const;
};

/// A look from patch q, traced with `view` of the mesh. At 128 pixels some milliseconds.
class HemicubeEye {
 public:
  static constexpr HemicubeLayout kLayout{128};

  explicit HemicubeEye(std::shared_ptr<const Mesh> mesh, const CancelToken& cancel = {});
  ~HemicubeEye();
  const std::shared_ptr<const Mesh>& mesh() const { return mesh_; }
  HemicubeLook look(std::uint32_t patch);

 private:
  struct Parts;
  std::shared_ptr<const Mesh> mesh_;
  std::unique_ptr<Parts> parts_;
};

/// Calls on the main thread.
class HemicubeLooks {
 public:
  /// `wake` is called, on any thread, when there is something new; may be empty.
  explicit HemicubeLooks(std::function<void()> wake);
  ~HemicubeLooks();
  HemicubeLooks(const HemicubeLooks&) = delete;
  HemicubeLooks& operator=(const HemicubeLooks&) = delete;

  /// What is to be looked at next; what was asked for before and not begun is not done.
  void want(std::shared_ptr<const Mesh> mesh, std::uint32_t patch);
  /// Whether what was wanted last is not there yet.
  bool pending() const;
  /// The newest; null before the first, and where looking failed.
  std::shared_ptr<const HemicubeLook> latest() const;
  /// Since when [wallSeconds()] it gets ready for another mesh, which takes its time where that is large;
  /// none where it does not.
  std::optional<double> preparing() const;
  /// Gives up what is wanted.
  void giveUp();
  /// Why it failed.
  std::optional<Error> problem() const;

 private:
  struct Wanted {
    std::shared_ptr<const Mesh> mesh;
    std::uint32_t patch;
  };
  void run(const std::stop_token& stop);

  std::function<void()> wake_;
  std::atomic<bool> given_up_{false};
  mutable std::mutex mutex_;  // of what follows
  std::condition_variable_any arrived_;
  std::optional<Wanted> wanted_;
  bool looking_ = false, closing_ = false;
  std::optional<double> preparing_;
  std::shared_ptr<const HemicubeLook> latest_;
  std::optional<Error> problem_;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace unshot

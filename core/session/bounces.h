// The light of a solve by bounces, worked out beside it once its form factors are there, and kept for
// display.
#pragma once

#include <memory>
#include <vector>

#include "session/snapshot.h"
#include "solver/bounce_series.h"

namespace unshot {

class Bounces {
 public:
  /// All outlive it.
  Bounces(std::shared_ptr<const Mesh> mesh, Transport& transport, const RadiosityState& state);

  /// Goes on for some milliseconds: with the light of one bounce more, or with a column that is missing where
  /// `compute` allows that. Returns whether anything is new.
  bool advance(bool compute);
  /// Whether advance() would have something to do.
  bool hasWork(bool compute);
  /// What is known now; null before anything is.
  std::shared_ptr<const BounceLight> light();
  /// What bounces still wait for.
  BounceWait wait();

 private:
  void follow();

  std::shared_ptr<const Mesh> mesh_;
  Transport& transport_;
  BounceSeries series_;
  bool no_room_ = false;  // a column was computed in vain: it does not fit into the memory for them
  std::size_t bytes_ = 0;
  std::vector<std::shared_ptr<const MeshField>> received_;  // by number of bounces, from 1 on
  std::shared_ptr<const BounceLight> light_;
};

}  // namespace unshot

// What the viewer does that takes its time, as it is shown: how far it is, and how to give it up.
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace unshot {

struct Task {
  std::string text;            ///< such as "reading room.obj"
  std::optional<double> done;  ///< from 0 to 1; none where it is not known
  const char* given_up;        ///< what becomes of it then, for a tooltip
  std::function<void()> giveUp;
  double since = 0;                       ///< wallSeconds()
  static constexpr double kMoment = 0.3;  // [s]
  /// Whether it has taken longer than a moment by now: before, it would only flash.
  bool shown(double now) const { return now >= since + kMoment; }
};

}  // namespace unshot

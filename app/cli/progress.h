// Progress on standard error: a bar on a terminal, plain lines elsewhere.
#pragma once

#include <cstdint>
#include <string>

namespace unshot {

/// Where a solve stands.
struct ProgressFigures {
  double done = 0;  ///< fraction of the way, 0..1
  double unshot_fraction = 1;
  double bound = 0;  ///< of the solver's error; infinite where there is none yet
  std::uint64_t shots = 0;
  double seconds = 0;
};

/// Writes nothing for a solve that is over at once. Not for two at a time.
class Progress {
 public:
  /// `max_seconds` bounds the time left that is shown; 0: no limit.
  explicit Progress(double max_seconds);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// What is being done now, such as "reading scene.obj"; shown on a terminal only.
  void phase(const std::string& text);
  /// Cheap enough to be called after every step.
  void update(const ProgressFigures& figures);
  /// The same for work of another kind: how much of it is done, and what is being done.
  void update(double done, const std::string& text);
  /// Takes the bar away.
  void finish();

 private:
  std::string lineOf(const ProgressFigures& figures) const;
  void say(double done, const std::string& plain_head, const std::string& text);
  void draw(const std::string& line);

  double max_seconds_;
  bool terminal_;
  bool drawn_ = false;
  double next_ = 0;      ///< wall time of the next output
  double interval_ = 0;  ///< between outputs [s]
};

}  // namespace unshot

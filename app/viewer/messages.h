// What the viewer has to say: errors, one after the other until each is dismissed; notices over the scene,
// some for a moment and some until they were read; and a log of all of it, which knows what nobody has read.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"

namespace unshot {

/// Times are wallSeconds().
class Messages {
 public:
  struct Logged {
    double time;
    std::string text;
    bool error;
    bool read = false;  ///< dismissed, or seen in the list of all of them; lines for a moment need not be
  };

  /// `of_solve`: about the scene or its solve, of no more interest once another one is there. The same once
  /// more, while it is still to be read, is only logged.
  void addError(const Error& error, bool of_solve, double now);
  /// The one that is to be read; null where there is none.
  const std::optional<Error>& error() const { return shown_; }
  /// How many come after it.
  std::size_t waiting() const { return waiting_.size(); }
  void dismissError();
  void forgetErrorsOfSolve();

  /// A line for a moment, which only echoes a key or a button, such as what it has chosen; instead of the one
  /// before.
  void addPassing(std::string text, double now);
  /// A line that stays until it is dismissed, or the user goes on working for a while; the same once more, in
  /// the place of the one before.
  void add(std::string text, double now);
  /// Something was typed, or moved with the mouse: takes some of the time of lines that stay. Returns whether
  /// one has gone.
  bool userActs(double now);
  /// Drops the passing line once it has had its time; returns whether it did.
  bool expire(double now);
  /// When that is; infinity: never, as things are.
  double nextExpiry() const;
  /// Drops the passing line: it would only be in the way.
  void clear() { passing_.reset(); }
  /// Drops lines that stay; returns whether there was one.
  bool dismissNotices();

  /// The lines of all notices, the newest last; no more than a few of them.
  std::vector<std::string> lines() const;
  /// Whether one of these stays until it is dismissed.
  bool stays() const { return !lasting_.empty(); }
  /// The newest last.
  const std::deque<Logged>& log() const { return log_; }
  /// How many of them nobody has read.
  std::size_t unread() const;
  /// The list of all of them is seen.
  void readAll();

 private:
  struct Lasting {
    std::string text;
    double rest;  ///< how long the user is still to work under it [s]
  };

  void note(std::string text, bool error, double now);
  void read(const std::string& text);
  void showNextError();

  std::optional<Error> shown_;
  bool shown_of_solve_ = false;
  std::deque<std::pair<Error, bool>> waiting_;
  std::optional<std::string> passing_;
  double passing_until_ = 0;
  std::deque<Lasting> lasting_;
  double last_act_ = 0;
  std::deque<Logged> log_;
};

}  // namespace unshot

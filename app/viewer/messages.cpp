#include "viewer/messages.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace unshot {
namespace {

constexpr double kPassingSeconds = 4;
constexpr double kReadSeconds = 6;  // of a user who goes on working
constexpr double kPause = 1;        // of a user who does: longer ones are time away
constexpr std::size_t kMostLines = 3;
constexpr std::size_t kMostLogged = 100;

}  // namespace

void Messages::note(std::string text, bool error, double now) {
  log_.push_back({now, std::move(text), error});
  if (log_.size() > kMostLogged) log_.pop_front();
}

void Messages::addError(const Error& error, bool of_solve, double now) {
  const std::string text = error.fullText();
  note(text, true, now);
  if (!shown_) {
    shown_ = error;
    shown_of_solve_ = of_solve;
    return;
  }
  const bool known = shown_->fullText() == text ||
                     std::any_of(waiting_.begin(), waiting_.end(),
                                 [&](const auto& other) { return other.first.fullText() == text; });
  if (!known) waiting_.emplace_back(error, of_solve);
}

void Messages::read(const std::string& text) {
  for (Logged& one : log_) one.read = one.read || one.text == text;
}

void Messages::readAll() {
  for (Logged& one : log_) one.read = true;
}

std::size_t Messages::unread() const {
  return static_cast<std::size_t>(
      std::count_if(log_.begin(), log_.end(), [](const Logged& one) { return !one.read; }));
}

void Messages::dismissError() {
  if (shown_) read(shown_->fullText());
  showNextError();
}

void Messages::showNextError() {
  shown_.reset();
  if (waiting_.empty()) return;
  shown_ = waiting_.front().first;
  shown_of_solve_ = waiting_.front().second;
  waiting_.pop_front();
}

void Messages::forgetErrorsOfSolve() {
  std::erase_if(waiting_, [](const auto& error) { return error.second; });
  if (shown_ && shown_of_solve_) showNextError();
}

void Messages::addPassing(std::string text, double now) {
  note(text, false, now);
  log_.back().read = true;
  passing_ = std::move(text);
  passing_until_ = now + kPassingSeconds;
}

void Messages::add(std::string text, double now) {
  note(text, false, now);
  std::erase_if(lasting_, [&](const Lasting& notice) { return notice.text == text; });
  lasting_.push_back({std::move(text), kReadSeconds});
}

bool Messages::userActs(double now) {
  const double seconds = std::clamp(now - std::exchange(last_act_, now), 0.0, kPause);
  for (Lasting& notice : lasting_) notice.rest -= seconds;
  return std::erase_if(lasting_, [](const Lasting& notice) { return notice.rest <= 0; }) > 0;
}

bool Messages::expire(double now) {
  if (now < nextExpiry()) return false;
  passing_.reset();
  return true;
}

double Messages::nextExpiry() const {
  return passing_ ? passing_until_ : std::numeric_limits<double>::infinity();
}

bool Messages::dismissNotices() {
  const bool any = !lasting_.empty();
  for (const Lasting& notice : lasting_) read(notice.text);
  lasting_.clear();
  return any;
}

std::vector<std::string> Messages::lines() const {
  std::vector<std::string> out;
  const std::size_t first = lasting_.size() > kMostLines ? lasting_.size() - kMostLines : 0;
  if (first > 0) out.push_back(std::to_string(first) + " more under \"Messages\" in the panel");
  for (std::size_t k = first; k < lasting_.size(); ++k) out.push_back(lasting_[k].text);
  if (passing_) out.push_back(*passing_);
  return out;
}

}  // namespace unshot

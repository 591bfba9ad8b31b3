// Columns of K computed once for several solves of the same scene and options. Each solve is charged what
// computing a column took, as if it had computed it itself: so its clock is that of a solve on its own, all
// modes pay the same for the same column, and a report takes a fraction of the time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "formfactor/method.h"

namespace unshot {

/// One thread; outlives the methods that it wraps.
class ColumnStore {
 public:
  struct Spent {
    double seconds = 0, cpu_seconds = 0;
  };

  /// Columns are kept up to so many bytes; those beyond are computed again each time.
  explicit ColumnStore(std::size_t bytes) : budget_(bytes) {}

  /// The method of one more solve; clocks start at zero. `method` must be the same for all solves.
  std::unique_ptr<FormFactorMethod> wrap(std::unique_ptr<FormFactorMethod> method);
  /// From here on a column is computed (and timed) once more before it is taken from here again.
  void measureAnew() { ++round_; }

  /// To be added to the clocks of the present solve for what it took from here.
  const Spent& charged() const { return charged_; }
  /// All that form factors cost the present solve, what was charged included.
  const Spent& spent() const { return spent_; }
  std::size_t bytes() const { return bytes_; }
  bool full() const { return full_; }  ///< some columns found no room

 private:
  class Method;
  struct Entry {
    std::unique_ptr<Column> column;
    Spent cost;
    std::uint64_t round = 0;  // in which the cost was measured
  };

  Column column(FormFactorMethod& method, std::uint32_t q);

  std::size_t budget_, bytes_ = 0;
  bool full_ = false;
  std::uint64_t round_ = 1;
  Spent charged_, spent_;
  std::vector<Entry> entries_;
};

}  // namespace unshot

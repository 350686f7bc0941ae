// Summaries of samples.
#pragma once

#include <cstddef>
#include <vector>

#include "tools/board/number_column.h"

namespace warmjoint::inline tools {

/// Median, quartiles and root mean square of a sample; NaN of an empty one.
struct Summary {
  double median;
  double q25;
  double q75;
  double rms;
};

/// The numbers of a column in ascending order, NaN left out. Memory does not grow with the column: of a
/// long one, each look at a position reads it up to four times.
class Ascending {
 public:
  explicit Ascending(const NumberColumn& column);

  std::size_t size() const { return size_; }

  /// The number at `position`, from 0; exact.
  double operator[](std::size_t position) const;

  /// The quantile at `share` in [0, 1], linear between neighbours; NaN of none.
  double Quantile(double share) const;

 private:
  const NumberColumn& column_;
  std::size_t size_ = 0;
  std::vector<double> sorted_;  // all of them where they are few
};

/// The quantile of `sorted` (ascending) at `share` in [0, 1], linear between neighbours; NaN where
/// it is empty.
double Quantile(const std::vector<double>& sorted, double share);

/// Summary of the numbers in `values`; NaN among them are left out.
Summary Summarise(const NumberColumn& values);

}  // namespace warmjoint::inline tools

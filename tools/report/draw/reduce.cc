#include "tools/report/draw/reduce.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace warmjoint::report {
namespace {

using Eigen::Index;

/// Cell of a value; -1 below the shown part or NaN, `count` above it.
int CellOf(double value, const PixelSpan& span) {
  const double place = (value - span.lower) / (span.upper - span.lower);
  if (!(place >= 0)) return -1;
  if (place > 1) return span.count;
  return std::min(span.count - 1, static_cast<int>(place * span.count));
}

/// Adds first, lowest, highest, last and a gap of [begin, end).
void AddColumn(const Eigen::VectorXd& y, Index begin, Index end, std::vector<Index>& chosen) {
  std::vector<Index> marks{begin, end - 1};
  Index low = -1, high = -1, gap = -1;
  for (Index i = begin; i < end; ++i) {
    if (std::isnan(y[i])) {
      gap = i;
      continue;
    }
    if (low < 0 || y[i] < y[low]) low = i;
    if (high < 0 || y[i] > y[high]) high = i;
  }
  for (Index mark : {low, high, gap}) {
    if (mark >= 0) marks.push_back(mark);
  }
  std::sort(marks.begin(), marks.end());
  marks.erase(std::unique(marks.begin(), marks.end()), marks.end());
  chosen.insert(chosen.end(), marks.begin(), marks.end());
}

/// Which pixels of a plot have a marker.
class TakenPixels {
 public:
  TakenPixels(int columns, int rows)
      : columns_(columns), rows_(rows), taken_(static_cast<std::size_t>(columns) * rows) {}

  /// Whether the pixel is in the plot and had no marker before.
  bool Take(int column, int row) {
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return false;
    const std::size_t cell = static_cast<std::size_t>(row) * columns_ + column;
    if (taken_[cell]) return false;
    return taken_[cell] = true;
  }

  /// Whether the marker of a pixel is below those of even rows and columns about it.
  bool Covers(int column, int row) const {
    if (column % 2 == 0 && row % 2 == 0) return false;
    if (column == 0 || row == 0 || column + 1 >= columns_ || row + 1 >= rows_) return false;
    for (int r = row - 1; r <= row + 1; ++r) {
      for (int c = column - 1; c <= column + 1; ++c) {
        if (!taken_[static_cast<std::size_t>(r) * columns_ + c]) return false;
      }
    }
    return true;
  }

 private:
  int columns_;
  int rows_;
  std::vector<bool> taken_;
};

}  // namespace

std::vector<Index> ReduceCurve(const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                               const PixelSpan& columns) {
  const Index n = x.size();
  std::vector<Index> chosen;
  if (n < 4 * Index{columns.count} || !std::is_sorted(x.begin(), x.end())) {
    chosen.resize(static_cast<std::size_t>(n));
    std::iota(chosen.begin(), chosen.end(), Index{0});
    return chosen;
  }
  for (Index begin = 0; begin < n;) {
    const int cell = CellOf(x[begin], columns);
    Index end = begin + 1;
    while (end < n && CellOf(x[end], columns) == cell) ++end;
    AddColumn(y, begin, end, chosen);
    begin = end;
  }
  return chosen;
}

std::vector<Index> ReduceScatter(const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                                 const PixelSpan& columns, const PixelSpan& rows, double radius) {
  TakenPixels taken(columns.count, rows.count);
  std::vector<Index> chosen;
  for (Index i = 0; i < x.size(); ++i) {
    if (taken.Take(CellOf(x[i], columns), CellOf(y[i], rows))) chosen.push_back(i);
  }
  constexpr double kCovering = 1.4;  // pixels to the next in the other rows and columns
  if (radius < kCovering) return chosen;
  std::erase_if(chosen,
                [&](Index i) { return taken.Covers(CellOf(x[i], columns), CellOf(y[i], rows)); });
  return chosen;
}

}  // namespace warmjoint::report

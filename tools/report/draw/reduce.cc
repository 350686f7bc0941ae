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
                                 const PixelSpan& columns, const PixelSpan& rows) {
  std::vector<bool> taken(static_cast<std::size_t>(columns.count) * rows.count);
  std::vector<Index> chosen;
  for (Index i = 0; i < x.size(); ++i) {
    const int column = CellOf(x[i], columns);
    const int row = CellOf(y[i], rows);
    if (column < 0 || row < 0 || column == columns.count || row == rows.count) continue;
    const std::size_t cell = static_cast<std::size_t>(row) * columns.count + column;
    if (!taken[cell]) chosen.push_back(i);
    taken[cell] = true;
  }
  return chosen;
}

}  // namespace warmjoint::report

#include "tools/figures/reduce.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace warmjoint::figures {
namespace {

using Eigen::Index;

/// Cell of a value; -1 below the shown part or NaN, `count` above it.
int CellOf(double value, const CellSpan& span) {
  const double place = (value - span.lower) / (span.upper - span.lower);
  if (!(place >= 0)) return -1;
  if (place > 1) return span.count;
  return std::min(span.count - 1, static_cast<int>(place * span.count));
}

/// Adds first, lowest, highest and last of what is known in [begin, end), and the gap over which it jumps farthest, between
/// its neighbours.
void AddColumn(const Eigen::VectorXd& y, Index begin, Index end, std::vector<Index>& chosen) {
  Index first = -1, last = -1, low = -1, high = -1;
  Index gap = -1, before = -1, after = -1;
  double jump = -1;
  for (Index i = begin; i < end; ++i) {
    if (std::isnan(y[i])) continue;
    if (first < 0) first = i;
    const double step = last < 0 ? INFINITY : std::abs(y[i] - y[last]);
    if (i > begin && std::isnan(y[i - 1]) && step > jump) {
      std::tie(gap, before, after, jump) = std::tuple(i - 1, last, i, step);
    }
    last = i;
    if (low < 0 || y[i] < y[low]) low = i;
    if (high < 0 || y[i] > y[high]) high = i;
  }
  if (first < 0) return chosen.push_back(begin);
  // what ends in a gap ends there
  std::vector<Index> marks{first, low, high, last};
  if (last + 1 < end) marks.push_back(last + 1);
  // in their order, and each once
  for (const Index mark : {before, gap, after}) {
    if (mark >= 0) marks.push_back(mark);
  }
  std::sort(marks.begin(), marks.end());
  marks.erase(std::unique(marks.begin(), marks.end()), marks.end());
  chosen.insert(chosen.end(), marks.begin(), marks.end());
}

}  // namespace

std::vector<Index> ReduceCurve(const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                               const CellSpan& columns) {
  const Index n = x.size();
  std::vector<Index> chosen;
  // few samples stay as they are, and so do curves that turn back
  if (n < 4 * Index{columns.count} || !std::is_sorted(x.begin(), x.end())) {
    chosen.resize(static_cast<std::size_t>(n));
    std::iota(chosen.begin(), chosen.end(), Index{0});
    return chosen;
  }
  // the samples of one column of the page stand for each other
  for (Index begin = 0; begin < n;) {
    const int cell = CellOf(x[begin], columns);
    Index end = begin + 1;
    while (end < n && CellOf(x[end], columns) == cell) ++end;
    AddColumn(y, begin, end, chosen);
    begin = end;
  }
  return chosen;
}

std::vector<Index> ReduceCloud(const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                               const CellSpan& columns, const CellSpan& rows) {
  std::vector<bool> taken(static_cast<std::size_t>(columns.count) * rows.count);
  std::vector<Index> chosen;
  for (Index i = 0; i < x.size(); ++i) {
    const int column = CellOf(x[i], columns), row = CellOf(y[i], rows);
    if (column < 0 || row < 0 || column >= columns.count || row >= rows.count) continue;
    // the first sample of a cell stands for all others in it
    const auto cell = static_cast<std::size_t>(column) * rows.count + row;
    if (!taken[cell]) chosen.push_back(i);
    taken[cell] = true;
  }
  return chosen;
}

}  // namespace warmjoint::figures

#include "tools/report/draw/reduce.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace warmjoint::report {
namespace {

using Eigen::Index;

/// Cell of a value; -1 below the shown part or NaN, `count` above it.
int CellOf(double value, const CellSpan& span) {
  const double place = (value - span.lower) / (span.upper - span.lower);
  if (!(place >= 0)) return -1;
  if (place > 1) return span.count;
  return std::min(span.count - 1, static_cast<int>(place * span.count));
}

/// Adds first, lowest, highest, last and a gap of [begin, end).
void AddColumn(const Eigen::VectorXd& y, Index begin, Index end, std::vector<Index>& chosen) {
  // ends, extremes and a gap are all that a column of the page shows
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
  // in their order, and each once
  for (Index mark : {low, high, gap}) {
    if (mark >= 0) marks.push_back(mark);
  }
  std::sort(marks.begin(), marks.end());
  marks.erase(std::unique(marks.begin(), marks.end()), marks.end());
  chosen.insert(chosen.end(), marks.begin(), marks.end());
}

/// The lowest and the highest sample of each cell.
class Cells {
 public:
  Cells(const Eigen::VectorXd& x, const Eigen::VectorXd& y, const CellSpan& columns,
        const CellSpan& rows)
      : rows_(rows.count),
        extremes_(static_cast<std::size_t>(columns.count) * rows.count, {-1, -1}) {
    // each cell keeps its lowest and its highest sample
    for (Index i = 0; i < x.size(); ++i) {
      const int column = CellOf(x[i], columns), row = CellOf(y[i], rows);
      if (column < 0 || row < 0 || column >= columns.count || row >= rows.count) continue;
      auto& [low, high] = extremes_[Place(column, row)];
      if (low < 0 || y[i] < y[low]) low = i;
      if (high < 0 || y[i] > y[high]) high = i;
    }
  }

  /// (-1, -1) where the cell has none.
  std::pair<Index, Index> At(int column, int row) const { return extremes_[Place(column, row)]; }

 private:
  std::size_t Place(int column, int row) const {
    return static_cast<std::size_t>(column) * rows_ + row;
  }

  int rows_;
  std::vector<std::pair<Index, Index>> extremes_;
};

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

std::vector<std::pair<Index, Index>> ReduceCloud(const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                                                 const CellSpan& columns, const CellSpan& rows,
                                                 double reach) {
  const Cells cells(x, y, columns, rows);
  std::vector<std::pair<Index, Index>> strokes;
  const double apart = reach * (rows.upper - rows.lower) / rows.count;  // in units of y
  // up each column: cells near enough to each other join into one stroke
  for (int column = 0; column < columns.count; ++column) {
    Index last = -1;
    for (int row = 0; row < rows.count; ++row) {
      const auto [low, high] = cells.At(column, row);
      if (low < 0) continue;
      // a gap wider than the reach begins a new stroke
      const bool goes_on = last >= 0 && y[low] - y[last] <= apart;
      if (!goes_on) strokes.emplace_back(low, high);
      strokes.back().second = high;
      last = high;
    }
  }
  return strokes;
}

}  // namespace warmjoint::report

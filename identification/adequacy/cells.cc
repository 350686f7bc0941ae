#include "identification/adequacy/cells.h"

#include <algorithm>
#include <cmath>

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;

constexpr Index kCells = 400;
constexpr double kOneSpeed = 0.02;  // relative

/// Tells whether a sample belongs to the cell that began at another one.
class Together {
 public:
  Together(const Measurements& measurements, const Selection& selection)
      : v_(measurements.velocity) {
    if (selection.segments.empty()) return;
    segment_.setConstant(v_.size(), -1);
    for (size_t s = 0; s < selection.segments.size(); ++s) {
      const Segment& segment = selection.segments[s];
      segment_.segment(segment.begin, segment.end - segment.begin) = static_cast<int>(s);
    }
  }

  bool operator()(Index first, Index other) const {
    if (segment_.size() == v_.size()) return segment_[first] == segment_[other];
    return std::abs(v_[other] - v_[first]) <= kOneSpeed * std::abs(v_[first]);
  }

 private:
  const Eigen::VectorXd& v_;
  Eigen::ArrayXi segment_;  // [N], or empty
};

}  // namespace

Cells MakeCells(const Measurements& measurements, const Selection& selection) {
  const Index most = 1 + selection.count() / kCells;
  const Together together(measurements, selection);
  Cells cells;
  for (Index i = 0; i < measurements.size(); ++i) {
    if (!selection.keep[i]) continue;
    const bool joins = !cells.end.empty() && cells.end.back() == i &&
                       i - cells.begin.back() < most && together(cells.begin.back(), i);
    if (!joins) {
      cells.begin.push_back(i);
      cells.end.push_back(i);
    }
    cells.end.back() = i + 1;
  }

  const auto m = static_cast<Index>(cells.begin.size());
  const Eigen::VectorXd& t = measurements.time;
  const double duration = t[t.size() - 1] - t[0];
  cells.weight.resize(m);
  cells.time.resize(m);
  for (Index c = 0; c < m; ++c) {
    cells.weight[c] = static_cast<double>(cells.end[c] - cells.begin[c]);
    cells.time[c] = (0.5 * (t[cells.begin[c]] + t[cells.end[c] - 1]) - t[0]) / duration;
  }
  cells.velocity = cells.Means(measurements.velocity);
  return cells;
}

Eigen::MatrixXd Cells::Means(const Eigen::MatrixXd& all) const {
  Eigen::MatrixXd means(size(), all.cols());
  for (Index column = 0; column < all.cols(); ++column) {
    for (Index c = 0; c < size(); ++c) {
      means(c, column) = all.col(column).segment(begin[c], end[c] - begin[c]).mean();
    }
  }
  return means;
}

}  // namespace warmjoint::inline identification

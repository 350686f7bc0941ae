// Samples of a fit taken together where the speed stays: what slow structure needs of them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/recording/measurements.h"
#include "models/recording/selection.h"

namespace warmjoint::inline identification {

/// Runs of neighbouring kept samples in one segment of constant speed, or, where the selection
/// knows no segments, within 2 % of one speed. At most a 400th of all kept samples each.
struct Bins {
  std::vector<Eigen::Index> begin;  // [m] first sample
  std::vector<Eigen::Index> end;    // [m] one past the last
  Eigen::VectorXd weight;           // [m] number of samples
  Eigen::VectorXd velocity;         // [m] mean, rad/s or m/s
  Eigen::VectorXd time;             // [m] middle, share of the recording, 0 to 1
  Eigen::VectorXd hold;             // [m] index of the segment; [0] where none are known
  Eigen::VectorXd phase;            // [m] middle, share of the segment, 0 to 1; [0] as hold

  Eigen::Index size() const { return weight.size(); }

  /// Means over each bin. all: [N x c] over all samples; returns [m x c].
  Eigen::MatrixXd Means(const Eigen::Ref<const Eigen::MatrixXd>& all) const;
};

/// Means over bins of rows that are made one after the other, a sample at a time from the first on. C: columns,
/// known so that a row stays in registers.
template <int C>
class BinMeans {
 public:
  using Row = Eigen::Matrix<double, 1, C>;

  explicit BinMeans(const Bins& bins) : bins_(bins), means_(bins.size(), C) {}

  /// row: of sample n; looked at where a bin holds the sample
  void Add(Eigen::Index n, const Row& row) {
    if (bin_ == bins_.begin.size() || n < bins_.begin[bin_]) return;
    sums_ += row;
    if (n + 1 < bins_.end[bin_]) return;
    means_.row(static_cast<Eigen::Index>(bin_)) =
        sums_ / static_cast<double>(bins_.end[bin_] - bins_.begin[bin_]);
    sums_.setZero();
    ++bin_;
  }

  /// Once all samples were added. [m x C]
  const Eigen::MatrixXd& means() const { return means_; }

 private:
  const Bins& bins_;
  size_t bin_ = 0;
  Row sums_ = Row::Zero();
  Eigen::MatrixXd means_;
};

Bins MakeBins(const Measurements& measurements, const Selection& selection);

/// The same, but eight of them a segment, fewer where there are more than a thousand segments: for what
/// changes within each one.
Bins BinsWithinHolds(const Measurements& measurements, const Selection& selection);

}  // namespace warmjoint::inline identification

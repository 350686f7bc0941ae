// Means over neighbouring samples of the same speed, which are enough to find slow structure in a residual.
#pragma once

#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <vector>

#include "models/foundation/four.h"

namespace warmjoint {

/// Runs of neighbouring kept samples in one segment of constant speed, or, where the selection
/// has no segments, in one direction. At most a 400th of all kept samples each.
struct Bins {
  std::vector<Eigen::Index> begin;  // [m] first sample
  std::vector<Eigen::Index> end;    // [m] one past the last
  Eigen::VectorXd weight;    // [m] number of samples, only of kept ones where `keep` was given
  Eigen::VectorXd velocity;  // [m] mean, rad/s or m/s
  Eigen::VectorXd time;      // [m] middle, share of the recording, 0 to 1
  Eigen::VectorXd hold;      // [m] index of the segment; [0] where none are known
  Eigen::VectorXd phase;     // [m] middle, share of the segment, 0 to 1; [0] as hold

  Eigen::Index size() const { return weight.size(); }

  /// Means over each bin, only of kept samples where `keep` is given. all: [N x c]
  /// over all samples; keep: [N] or none; returns [m x c].
  Eigen::MatrixXd Means(const Eigen::Ref<const Eigen::MatrixXd>& all,
                        const bool* keep = nullptr) const;
  /// Subtracts one number for each bin from all of its samples. numbers: [m]; all: [N]
  void TakeOff(const Eigen::VectorXd& numbers, Eigen::VectorXd& all) const;
};

/// Means over each bin of rows that are made one after the other: row(n, numbers) makes that of sample n and is called for
/// each sample from the first on. Returns [m x 4 F]. Part of a function for each processor (four.h).
template <std::size_t F, typename MakeRow>
inline Eigen::MatrixXd MeansOfRows(const Bins& bins, MakeRow&& row) {
  Eigen::MatrixXd means(bins.size(), 4 * F);
  Eigen::Index n = 0;
  for (Eigen::Index stretch = 0; stretch < 2 * bins.size(); ++stretch) {
    // the samples before a bin, and then its own
    const auto bin = static_cast<std::size_t>(stretch / 2);
    const bool own = stretch % 2 == 1;
    const Eigen::Index first = n, end = own ? bins.end[bin] : bins.begin[bin];
    Fours<F> sums{};
    for (; n < end; ++n) {
      Fours<F> numbers;
      row(n, numbers);
      for (std::size_t k = 0; k < F; ++k) sums[k] += numbers[k];
    }
    if (!own) continue;
    const auto count = static_cast<double>(end - first);
    for (std::size_t k = 0; k < F; ++k) {
      for (Eigen::Index i = 0; i < 4; ++i) {
        means(stretch / 2, 4 * static_cast<Eigen::Index>(k) + i) = sums[k][i] / count;
      }
    }
  }
  return means;
}

Bins MakeBins(const LogSamples& measurements, const Selection& selection);

/// The same, but with eight bins in each segment, fewer where there are more than a thousand segments. They are for
/// structure that changes within each segment.
Bins BinsWithinHolds(const LogSamples& measurements, const Selection& selection);

}  // namespace warmjoint

// Output-error fit of the thermal filter H(z), Eq. (22).
#pragma once

#include <warmjoint/recording.h>

#include <Eigen/Core>

#include "identification/forward/thermal_filter.h"

namespace warmjoint {

/// Fits gain and time constant of H to a given energy: the sum over the kept samples of
/// (E - H W)^2 is smallest. The filter runs over all samples: one that is not kept (at rest,
/// accelerating) still warms or cools the joint.
///
/// The gain is linear and is eliminated (Golub and Pereyra 1973): what is left is a function of
/// ln tau alone, minimised by Newton steps on its exact first and second derivative.
class OutputError {
 public:
  struct Fit {
    Thermal thermal;
    double cost = 0;      // sum of squares over the kept samples, (N.m)^2 or N^2
    bool inside = false;  // tau lies within [shortest, longest]; where it does not, it is at one
  };

  /// time: [N] s; loss: [N] W; keep: [N]; starts: samples at which the joint is cold again.
  OutputError(const Eigen::VectorXd& time, const Eigen::VectorXd& loss, const Selection& selection,
              const std::vector<Eigen::Index>& starts = {});

  /// Smallest and largest time constant tried, s: a tenth of a step, and 100 times the recording.
  /// Beyond them the samples cannot tell one from another.
  double shortest() const { return shortest_; }
  double longest() const { return longest_; }

  /// The time constant on a grid (8 a decade from a step to 10 times the recording) whose fit to
  /// `energy` is best: a start from which Refine finds the smallest of several minima. s.
  double Scan(const Eigen::VectorXd& energy) const;

  /// The minimum nearest to a time constant (s). energy: [N] N.m or N, read at kept samples.
  Fit Refine(const Eigen::VectorXd& energy, double start) const;

  const ThermalFilter& filter() const { return filter_; }
  const Eigen::VectorXd& loss() const { return loss_; }

 private:
  struct Slice;  // the cost along ln tau: value and derivatives
  Slice Evaluate(const Eigen::VectorXd& energy, double log_time_constant) const;

  ThermalFilter filter_;
  Eigen::VectorXd loss_;  // [N] W
  Eigen::VectorXd kept_;  // [N] 1 where a sample is kept, else 0
  double shortest_;
  double longest_;
};

}  // namespace warmjoint

// The loop of Algorithm 1: energy and nominal friction fitted in turn.
#pragma once

#include <warmjoint/prepared_log.h>

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
    bool inside = false;  // tau lies within those that are tried; else at an end of them
  };

  /// time: [N] s; loss: [N] W; keep: [N]; starts: samples at which the joint is cold again.
  OutputError(const Eigen::VectorXd& time, const Eigen::VectorXd& loss, const Selection& selection,
              const std::vector<Eigen::Index>& starts);

  /// Smallest time constant tried, s.
  double shortest() const { return shortest_; }

  /// The time constant on a grid (8 a decade from a step to 10 times the recording) whose fit to
  /// `energy` is best: a start from which Refine finds the smallest of several minima. s.
  double Scan(const Eigen::VectorXd& energy) const;

  /// The minimum nearest to a time constant (s). energy: [N] N.m or N, read at kept samples.
  Fit Refine(const Eigen::VectorXd& energy, double start) const;

  const ThermalFilter& filter() const { return filter_; }
  const Eigen::VectorXd& loss() const { return loss_; }

 private:
  /// The cost along ln tau: at the best gain its value and derivatives.
  struct Slice {
    double gain = 0, cost = 0, slope = 0, curvature = 0;
  };
  Slice Evaluate(const Eigen::VectorXd& energy, double log_time_constant) const;

  ThermalFilter filter_;
  Eigen::VectorXd loss_;  // [N] W
  Eigen::VectorXd kept_;  // [N] 1 where a sample is kept, else 0
  // time constants that are tried, s: a tenth of a step, and 100 times the recording; beyond them the
  // samples cannot distinguish one from another
  double shortest_;
  double longest_;
};

/// The state of the loop after an iteration.
struct DescentState {
  Eigen::VectorXd nominal;  // [d] parameters of Fn
  Thermal thermal;
  double rmse = 0;     // of tau - Fn - sign(v) E over the kept samples, N.m or N
  bool inside = true;  // the time constant lies within the bounds of OutputError
};

/// Algorithm 1 of the paper, on samples with losses W = |(tau - G) v| (19). Only samples that are
/// kept and in motion take part in the fits of (22) and (24); the filter runs over all.
class BlockDescent {
 public:
  /// columns: [N x d] regressor of Fn + G over all samples; cofactor: [d x d] (A^T A)^-1 of the
  /// kept ones in motion, with the prior's strength where there are kernels; gravity: [N] G, which
  /// makes no heat, N.m or N.
  BlockDescent(const LogSamples& measurements, const Selection& moving,
               const Eigen::MatrixXd& columns, const Eigen::MatrixXd& cofactor,
               const Eigen::VectorXd& gravity);

  /// Iteration 0: E = H0 W, then Fn by (24), from a time constant that is not shorter than those tried. H0 is used
  /// first, because a start from plain least squares would not depend on it.
  DescentState Start(Thermal start) const;

  /// One iteration from `state`: E by (23), H by output error, E = H W, Fn by (24).
  DescentState Next(const DescentState& state) const;

  /// The time constant from which the first fit of H starts, s: the best one on a grid.
  double ScanFrom(const DescentState& state) const;

  /// sign(v) E over all samples, 0 where not kept. [N] N.m or N.
  Eigen::VectorXd Warming(const Thermal& thermal) const;

  /// Fitted torque Fn + sign(v) E over all samples, 0 where not kept. [N] N.m or N.
  Eigen::VectorXd Fitted(const DescentState& state) const;

  /// Derivatives of Fitted by (nominal, gain, ln tau). [N x (d + 2)], 0 where not kept.
  Eigen::MatrixXd Jacobian(const DescentState& state) const;

 private:
  Eigen::VectorXd MeasuredEnergy(const Eigen::VectorXd& nominal) const;
  DescentState WithNominal(const Thermal& thermal, bool inside) const;

  // rows of samples that are not kept, or not in motion, are 0
  Eigen::VectorXd sign_;     // [N]
  Eigen::VectorXd torque_;   // [N] N.m or N
  Eigen::MatrixXd columns_;  // [N x d]
  Eigen::MatrixXd cofactor_;
  OutputError output_error_;
  double kept_;
};

}  // namespace warmjoint

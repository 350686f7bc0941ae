// What the residual of a fit still shows: the whole table of tests for lack of fit on one log.
#pragma once

#include <warmjoint/recording.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identification/inference/inference.h"
#include "identification/lack_of_fit/finding.h"

namespace warmjoint {

/// The outcome of every test, and how much the log's assumptions matter.
struct Examination {
  std::vector<Finding> findings;    // one for each row of the table, in its order
  std::vector<size_t> rows;         // [p] of the fit's table that `moves` are about
  Eigen::VectorXd moves;            // [p] change of each once what was found joins the fit
  Eigen::VectorXd move_deviations;  // [p]
  /// [p] most that those among them that return with every hold, or differ by direction, move each by means, which
  /// nobody sees; empty where there are none.
  Eigen::VectorXd by_hidden;
  /// [p] most that a hint moves each: what a test by itself would reject at the error level, and the log, where
  /// as many are made, does not. Empty where there is none.
  Eigen::VectorXd by_hints;
  Eigen::VectorXd by_start;  // [p] change of each had the joint been a tenth as warm at the start
                             // as it ever gets; empty where its start is no matter
  Eigen::VectorXd by_drift;  // [p] largest change of each by a slow drift of a hundredth of the
                             // friction over the log, even or fading
  double open_start = 0;     // the warmest E(0) that the log leaves open, N.m or N (left_open.h)
  Eigen::VectorXd by_open_start;  // [p] change of each by that; empty as by_start
  Eigen::VectorXd
      by_open_drift;  // [p] most that a slow drift that the log leaves open changes each
  Eigen::VectorXd
      by_open_curve;  // [p] most that a square of the speed that the log leaves open changes each
  Eigen::VectorXd by_open_memory;  // [p] the same of friction that follows the speed late
  double dead_band = 0;            // least torque of the log, N.m or N
  Eigen::VectorXd
      by_dead_band;  // [p] change of each had the torque's sensor a dead band as wide as that
  Eigen::VectorXd
      by_degrees;  // [p] most change of each had angles been in degrees; empty of sliding joints
  Eigen::VectorXd by_clock;  // [p] most change of each by a clock that is off by a hundredth
  Eigen::VectorXd by_gaps;   // [p] most that the gaps of the log may have moved each; empty where
                             // there are none, or where the fit has taken care of them
  Eigen::VectorXd
      by_rounding;  // [p] change of each once what the torque's steps do is taken off (rounding.h); empty where
                    // noise evens them out
  Eigen::VectorXd by_steps;  // [p] most that steps hide of each; empty where they hide nothing
  Eigen::VectorXd by_heat;   // [p] change of each had the losses followed the heat within the steps
                             // of the log; empty where that is no matter
  double heat_share = 0;     // of that, as the residual tells: 1 where they did, 0 where they were
                             // held (22)
  double heat_deviation = 0;  // standard deviation of the share
  double friction = 0;        // rms of law and heat over the kept samples, N.m or N
  double samples = 0;
  double squares = 0;  // of the residual

  /// Rms over the kept samples of what a finding explains, N.m or N.
  double Rms(const Finding& finding) const;

  /// Those that were rejected, the largest first.
  std::vector<const Finding*> Found() const;

  /// Those that were not, though each by itself would have been.
  std::vector<const Finding*> Hints() const;
};

/// Makes all tests at one error level (error_level.h). Where they cannot be made each says why.
/// inference: of the fit; selection: samples at constant speed.
Examination ExamineResidual(const Fit& fit, const Inference& inference,
                            const Measurements& measurements, const Selection& selection);

/// The table of tests, none made: for one reason, or where that is empty each for its own.
std::vector<Finding> NotMade(const std::string& reason);

}  // namespace warmjoint

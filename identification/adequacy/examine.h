// What the residual of a fit still shows.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identification/adequacy/structure.h"
#include "identification/inference/inference.h"
#include "models/recording/measurements.h"

namespace warmjoint::inline identification {

/// Structure of the residual, in the order of size.
struct Adequacy {
  std::vector<Structure> found;
  std::vector<size_t> rows;         // [p] of the fit's table that `moves` are about
  Eigen::VectorXd moves;            // [p] change of each once the smooth structure joins the fit
  Eigen::VectorXd move_deviations;  // [p]
  Eigen::VectorXd reach;            // [p] force of each parameter's unit, rms over the kept samples
  Eigen::VectorXd by_start;  // [p] change of each had the joint been a tenth as warm at the start
                             // as it ever gets; empty where its start is no matter
  Eigen::VectorXd by_gaps;   // [p] most that the gaps of the log may have moved each; empty where
                             // there are none, or where the fit has taken care of them
  Eigen::VectorXd by_heat;   // [p] change of each had the losses followed the heat within the steps
                             // of the log; empty where that is no matter
  double heat_share = 0;     // of that, as the residual tells: 1 where they did, 0 where they were
                             // held (22)
  double heat_deviation = 0;  // standard deviation of the share
  double friction = 0;        // rms of the kept torque, N.m or N
  double samples = 0;
  double squares = 0;  // of the residual

  double Rms(const Structure& structure) const;
};

/// Looks for structure. inference: of the fit; selection: samples at constant speed. Nothing where there is no fit, or the samples are too
/// few.
Adequacy ExamineResidual(const Fit& fit, const Inference& inference,
                         const Measurements& measurements, const Selection& selection);

}  // namespace warmjoint::inline identification

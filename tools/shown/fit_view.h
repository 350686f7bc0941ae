// One recording and its estimate, worked out for pictures and pages.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>
#include <warmjoint/recording.h>

#include <optional>
#include <string>

#include "models/friction/along_motion.h"

namespace warmjoint::shown {

/// What a friction says at one speed along a recording. [N] of the recording.
struct AtSpeed {
  double speed = 0;           // rad/s or m/s, forwards
  double cold = 0;            // friction of a cold joint, torque unit
  Eigen::VectorXd force;      // with the heat of each sample, torque unit
  Eigen::VectorXd deviation;  // standard deviation of it; empty where it is not known
};

/// What everything that is shown of one recording shares. All vectors: [N] of the recording unless said.
struct FitView {
  std::string source;  // file of the recording
  JointKind joint = JointKind::rotary;
  std::string torque_unit;
  Estimate estimate;
  Selection selection;

  Eigen::VectorXd time;      // s, from the first sample
  Eigen::VectorXd position;  // rad or m
  Eigen::VectorXd velocity;  // rad/s or m/s
  Eigen::VectorXd torque;    // torque_unit, less `rigid`
  Eigen::VectorXd
      rigid;  // torque_unit, gravity and inertia as far as the estimate has them; else 0
  /// Motor angle, rad, 0 ... 2 pi; empty where neither it nor a gear is known.
  Eigen::VectorXd motor_angle;
  JointTrajectory trajectory;  // what the forward model reads of the recording
  ThermalStart start;          // what the estimate says of its heat at first and at gaps

  // with a friction in the estimate alone
  bool has_fit = false;
  Eigen::VectorXd fitted;  // F, torque_unit, as the log shows it with a lag of the torque
  Eigen::VectorXd energy;  // E, torque_unit; 0 where nothing warms

  // standard deviations by the estimate's parameters; empty where they are not known
  Eigen::VectorXd energy_std;       // of E, torque_unit
  std::optional<AtSpeed> at_speed;  // of a law that warms, without maps

  bool warms() const { return has_fit && estimate.friction->thermal.has_value(); }
  bool has_maps() const { return has_fit && !estimate.friction->maps.empty(); }
};

/// Runs the estimate's friction over the recording as the fit saw it: with its accelerations where the
/// estimate has an inertia.
FitView MakeFitView(const PreparedLog& log, const Estimate& estimate);

/// The same over samples that are given.
FitView MakeFitView(const LogSamples& measurements, const Selection& selection,
                    const Estimate& estimate);

/// The same with what the friction gave along the recording, where that is known.
FitView MakeFitView(const LogSamples& measurements, const Selection& selection,
                    const Estimate& estimate, const Prediction& given);

/// Whether the fit was to motion of any kind.
bool IsOfAnyMotion(const FitView& view);

/// The entries of the kept samples. all: [N]; returns [n].
Eigen::VectorXd KeptOf(const FitView& view, const Eigen::VectorXd& all);

/// Torque less fit at the kept samples, [n].
Eigen::VectorXd Residuals(const FitView& view);

/// Mean size of the load at the kept samples, N.m or N, of a friction that grows with it; else 0.
double MeanLoad(const FitView& view);

/// Where the joint was at sample i of the recording, as SlidingForce reads it.
JointPlace PlaceAt(const FitView& view, Eigen::Index i);

/// The energy of largest size along the recording, torque_unit.
double WarmestEnergy(const FitView& view);

}  // namespace warmjoint::shown

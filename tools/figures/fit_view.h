// One recording and its estimate, worked out for pictures.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>
#include <warmjoint/recording.h>

#include <string>

#include "models/friction/along_motion.h"
#include "tools/figures/figure.h"

namespace warmjoint::figures {

/// What the panels about one recording share. All vectors: [N] of the recording unless said.
struct FitView {
  std::string source;  // file of the recording
  JointKind joint = JointKind::rotary;
  std::string torque_unit;  // as set in print
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
  Eigen::VectorXd fitted;  // F, torque_unit, as the log shows it behind a lag of the torque
  Eigen::VectorXd energy;  // E, torque_unit; 0 where nothing warms

  // standard deviations by the estimate's parameters; empty where they are not known
  Eigen::VectorXd energy_std;  // of E, torque_unit

  bool warms() const { return has_fit && estimate.friction->thermal.has_value(); }
  /// Whether the verdict voids the fit: it is shown to be looked at alone.
  bool is_void() const { return has_fit && estimate.status != Status::ok; }
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

/// "fit", or "fit (void)", and how its lines are drawn.
std::string FitLabel(const FitView& view);
Dash FitDash(const FitView& view);

/// The entries with NaN at the samples that are not kept, so that lines break there. all: [N].
Eigen::VectorXd KeptOrGap(const FitView& view, const Eigen::VectorXd& all);

/// Where the joint was at sample i of the recording, as SlidingForce reads it.
JointPlace PlaceAt(const FitView& view, Eigen::Index i);

/// The sample at which the energy is of largest size, and that energy, torque_unit.
Eigen::Index WarmestSample(const FitView& view);
double WarmestEnergy(const FitView& view);

/// Where the numbers come from: "day/log.csv, identified by energy-ml", or "..., the truth" where
/// no identifier is named.
std::string OriginOf(const FitView& view);

/// What is taken off the torque that a view shows: "gravity and inertia"; empty: nothing.
std::string TakenOff(const FitView& view);

/// "; 3 of the samples are beyond the axes" for a subtitle, nothing where there are none.
std::string BeyondText(Eigen::Index samples);

/// Axis names with units of the joint: "speed (rad/s)".
std::string TimeLabel(const FitView& view);
std::string PositionLabel(const FitView& view);
std::string SpeedLabel(const FitView& view);
std::string TorqueLabel(const FitView& view, const std::string& what);

/// Seconds by which TimeLabel's unit is measured: 1, 60 or 3600.
double TimeUnit(const FitView& view);
/// Its name: "s", "min" or "h".
std::string TimeUnitName(const FitView& view);
/// The axis over the time of the whole recording.
Axis TimeAxis(const FitView& view);

}  // namespace warmjoint::figures

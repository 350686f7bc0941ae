#include "tools/shown/fit_view.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <vector>

#include "identification/answer/settling.h"
#include "identification/fit/fit_parameters.h"
#include "identification/fit/seen_samples.h"
#include "identification/forward/log_trajectory.h"
#include "identification/warming/initial_energy.h"
#include "models/foundation/low_pass.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/measurements.h"
#include "tools/shown/friction_spread.h"

namespace warmjoint::shown {
namespace {

/// Leaves friction in the torque, where gravity and inertia are known.
void TakeRigidOff(const Estimate& estimate, const LogSamples& measurements, FitView& view) {
  view.rigid = Eigen::VectorXd::Zero(measurements.size());

  // the inertia's torque, and gravity's
  const std::optional<double> inertia = ValueOf(Role::inertia, estimate);
  if (inertia && measurements.acceleration) view.rigid += *inertia * *measurements.acceleration;
  if (estimate.gravity) view.rigid += estimate.gravity->Torque(view.position);
  view.torque -= view.rigid;

  // beyond the places that gravity is known at, nothing can be compared
  if (!estimate.gravity) return;
  const GravityModel& gravity = *estimate.gravity;
  for (Eigen::Index i = 0; i < view.position.size(); ++i) {
    view.selection.keep[i] = view.selection.keep[i] && gravity.Covers(view.position[i]);
  }
}

Eigen::VectorXd MotorAngle(const LogSamples& measurements) {
  const auto turn = [](double angle) {
    return angle - 2 * std::numbers::pi * std::floor(angle / (2 * std::numbers::pi));
  };
  if (!KnowsMotorAngle(measurements)) return {};
  return MotorPosition(measurements).unaryExpr(turn);
}

/// The file with the folder that it is in: many are called recording.csv. Of several recordings all, as they were given.
std::string SourceOf(const LogSamples& measurements) {
  if (!measurements.further_starts.empty()) return measurements.source;
  const std::filesystem::path path = measurements.source;
  return path.parent_path().filename() / path.filename();
}

FitView WithoutFit(const LogSamples& measurements, const Selection& selection,
                   const Estimate& estimate) {
  FitView view;
  // the recording, its time counted from the first sample
  view.source = SourceOf(measurements);
  view.joint = measurements.joint;
  view.torque_unit = measurements.torque_unit;
  view.estimate = estimate;
  view.selection = selection;
  view.time = measurements.time.array() - measurements.time[0];
  view.position = measurements.position;
  view.velocity = measurements.velocity;
  view.torque = measurements.torque;
  // less the torque of inertia and gravity, what is left is friction
  TakeRigidOff(estimate, measurements, view);
  view.motor_angle = MotorAngle(measurements);

  // the motion as the prediction needs it, with the heat that it starts from
  view.trajectory = TrajectoryOf(measurements);
  view.start = StartOf(estimate, measurements);
  return view;
}

/// A round speed, 1, 2 or 5 times a power of ten, near the median of the kept samples that move forwards; 0 where none does.
double TypicalSpeed(const FitView& view) {
  std::vector<double> speeds;
  for (const double velocity : KeptOf(view, view.velocity)) {
    if (velocity > 0) speeds.push_back(velocity);
  }
  if (speeds.empty()) return 0;
  std::sort(speeds.begin(), speeds.end());
  const double median = speeds[speeds.size() / 2];
  const double decade = std::pow(10, std::floor(std::log10(median)));
  double nearest = decade;
  for (const double round : {2 * decade, 5 * decade, 10 * decade}) {
    if (std::abs(std::log(round / median)) < std::abs(std::log(nearest / median))) nearest = round;
  }
  return nearest;
}

/// How sure the heat is, and what friction at one speed makes of it.
void AddHeat(FitView& view) {
  const Eigen::Index n = view.time.size();
  const double speed = view.has_maps() ? 0 : TypicalSpeed(view), load = MeanLoad(view);
  // E at each sample, and behind it the friction at the speed
  const auto predict = [&](const Friction& friction) -> Eigen::VectorXd {
    Eigen::VectorXd both(speed > 0 ? 2 * n : n);
    both.head(n) = AlongMotion(friction).Predict(view.trajectory, view.start).energy;
    if (speed > 0) {
      const JointFriction joint(friction);
      both.tail(n) = both.head(n).unaryExpr([&](double energy) {
        return joint.SlidingForce(speed, {0, energy, load});
      });
    }
    return both;
  };
  const Eigen::VectorXd deviation =
      SpreadOfPrediction(SpreadOf(view.estimate), *view.estimate.friction, predict);
  if (deviation.size() > 0) view.energy_std = deviation.head(n);
  if (speed == 0) return;
  const JointFriction joint(*view.estimate.friction);
  AtSpeed at{speed, joint.SlidingForce(speed, {0, 0, load}), Eigen::VectorXd(n), {}};
  for (Eigen::Index i = 0; i < n; ++i) {
    at.force[i] = joint.SlidingForce(speed, {0, view.energy[i], load});
  }
  if (deviation.size() > 0) at.deviation = deviation.tail(n);
  view.at_speed = at;
}

}  // namespace

FitView MakeFitView(const PreparedLog& log, const Estimate& estimate) {
  const auto& [measurements, selection] =
      SeenByModel(ValueOf(Role::inertia, estimate), View::raw, log);
  return MakeFitView(measurements, selection, estimate);
}

FitView MakeFitView(const LogSamples& logged, const Selection& asked, const Estimate& estimate) {
  if (!estimate.friction) return WithoutFit(logged, asked, estimate);
  // the motion that the torque follows
  const bool grows = estimate.friction->load_gain != 0 && estimate.gravity;
  const auto other = Followed(
      logged, asked, {grows ? &*estimate.gravity : nullptr, ValueOf(Role::delay, estimate)});
  const LogSamples& measurements = other ? other->measurements : logged;
  const Selection& selection = other ? other->selection : asked;
  return MakeFitView(measurements, selection, estimate,
                     PredictFriction(*estimate.friction, measurements,
                                     StartOf(estimate, measurements), BristleStart::torque));
}

FitView MakeFitView(const LogSamples& measurements, const Selection& selection,
                    const Estimate& estimate, const Prediction& given) {
  FitView view = WithoutFit(measurements, selection, estimate);

  // the fit as the log would have it, behind the torque's lag
  view.has_fit = true;
  view.fitted = given.force;
  if (const std::optional<double> lag = ValueOf(Role::lag, estimate)) {
    view.fitted = LowPass(view.time, given.force + view.rigid, *lag) - view.rigid;
  }
  // what had not settled is no matter of the fit
  if (estimate.settling) {
    view.selection = WithoutSettling(view.selection, view.time, *estimate.settling);
  }

  view.energy = given.energy;
  if (view.warms()) AddHeat(view);
  return view;
}

bool IsOfAnyMotion(const FitView& view) { return Find(Role::inertia, view.estimate) != nullptr; }

double MeanLoad(const FitView& view) {
  const bool grows = view.has_fit && view.estimate.friction->load_gain != 0;
  if (!grows || view.trajectory.load.size() == 0) return 0;
  return KeptOf(view, view.trajectory.load).cwiseAbs().mean();
}

Eigen::VectorXd KeptOf(const FitView& view, const Eigen::VectorXd& all) {
  return Chosen(all, view.selection.keep);
}

Eigen::VectorXd Residuals(const FitView& view) { return KeptOf(view, view.torque - view.fitted); }

JointPlace PlaceAt(const FitView& view, Eigen::Index i) {
  const double load = view.trajectory.load.size() > 0 ? view.trajectory.load[i] : 0;
  return {view.position[i], view.energy[i], load, view.trajectory.motor_position[i]};
}

double WarmestEnergy(const FitView& view) {
  Eigen::Index at = 0;
  view.energy.cwiseAbs().maxCoeff(&at);
  return view.energy[at];
}

}  // namespace warmjoint::shown

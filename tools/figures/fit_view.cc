#include "tools/figures/fit_view.h"

#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>

#include "identification/answer/settling.h"
#include "identification/fit_parameters.h"
#include "identification/forward/log_trajectory.h"
#include "identification/preparation/delayed_motion.h"
#include "identification/seen_samples.h"
#include "identification/warming/initial_energy.h"
#include "models/foundation/low_pass.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/measurements.h"
#include "tools/figures/friction_spread.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

struct TimeScale {
  double seconds;
  const char* unit;
};

TimeScale ScaleOf(const FitView& view) {
  const double duration = view.time.size() ? view.time.tail(1)[0] : 0;
  if (duration > 3 * 3600) return {3600, "h"};
  if (duration > 300) return {60, "min"};
  return {1, "s"};
}

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
  view.torque_unit = UnitText(measurements.torque_unit);
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

}  // namespace

FitView MakeFitView(const PreparedLog& log, const Estimate& estimate) {
  const auto& [measurements, selection] =
      SeenByModel(ValueOf(Role::inertia, estimate), View::raw, log);
  return MakeFitView(measurements, selection, estimate);
}

FitView MakeFitView(const LogSamples& logged, const Selection& asked, const Estimate& estimate) {
  // a torque that is late follows the motion of before
  const std::optional<double> delay = ValueOf(Role::delay, estimate);
  const bool is_late = delay && logged.acceleration;
  const LogView late = is_late ? Delayed({logged, asked}, *delay) : LogView{};
  const LogSamples& measurements = is_late ? late.measurements : logged;
  const Selection& selection = is_late ? late.selection : asked;
  if (!estimate.friction) return WithoutFit(measurements, selection, estimate);
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
  if (const double settling = SettlingTime(view.selection, view.time, Residuals(view))) {
    view.selection = WithoutSettling(view.selection, view.time, settling);
  }

  // how sure the heat is
  view.energy = given.energy;
  if (view.warms()) {
    const FrictionSpread spread = SpreadOf(estimate);
    view.energy_std = SpreadOfPrediction(
        spread, *estimate.friction, [&](const Friction& friction) -> Eigen::VectorXd {
          return AlongMotion(friction).Predict(view.trajectory, view.start).energy;
        });
  }
  return view;
}

bool IsOfAnyMotion(const FitView& view) { return Find(Role::inertia, view.estimate) != nullptr; }

Eigen::VectorXd KeptOf(const FitView& view, const Eigen::VectorXd& all) {
  return Chosen(all, view.selection.keep);
}

Eigen::VectorXd Residuals(const FitView& view) { return KeptOf(view, view.torque - view.fitted); }

std::string FitLabel(const FitView& view) { return view.is_void() ? "fit (void)" : "fit"; }

Dash FitDash(const FitView& view) { return view.is_void() ? Dash::dashed : Dash::solid; }

Eigen::VectorXd KeptOrGap(const FitView& view, const Eigen::VectorXd& all) {
  return view.selection.keep.select(all.array(), std::nan(""));
}

JointPlace PlaceAt(const FitView& view, Eigen::Index i) {
  const double load = view.trajectory.load.size() > 0 ? view.trajectory.load[i] : 0;
  return {view.position[i], view.energy[i], load, view.trajectory.motor_position[i]};
}

Eigen::Index WarmestSample(const FitView& view) {
  Eigen::Index at = 0;
  view.energy.cwiseAbs().maxCoeff(&at);
  return at;
}

double WarmestEnergy(const FitView& view) { return view.energy[WarmestSample(view)]; }

std::string OriginOf(const FitView& view) {
  const std::string& identifier = view.estimate.identifier;
  return identifier.empty() ? fmt::format("{}, the truth", view.source)
                            : fmt::format("{}, identified by {}", view.source, identifier);
}

std::string TakenOff(const FitView& view) {
  const bool gravity = view.estimate.gravity.has_value(), inertia = IsOfAnyMotion(view);
  if (gravity && inertia) return "gravity and inertia";
  return gravity ? "gravity" : inertia ? "inertia" : "";
}

std::string BeyondText(Eigen::Index samples) {
  if (samples == 0) return "";
  return fmt::format("; {} of the samples {} beyond the axes", samples,
                     samples == 1 ? "is" : "are");
}

std::string TimeLabel(const FitView& view) { return fmt::format("time ({})", ScaleOf(view).unit); }

double TimeUnit(const FitView& view) { return ScaleOf(view).seconds; }

std::string TimeUnitName(const FitView& view) { return ScaleOf(view).unit; }

Axis TimeAxis(const FitView& view) {
  return {TimeLabel(view), 0, view.time.tail(1)[0] / TimeUnit(view)};
}

std::string PositionLabel(const FitView& view) {
  return fmt::format("position ({})", UnitText(kPositionUnit.For(view.joint)));
}

std::string SpeedLabel(const FitView& view) {
  return fmt::format("velocity ({})", UnitText(kVelocityUnit.For(view.joint)));
}

std::string TorqueLabel(const FitView& view, const std::string& what) {
  return fmt::format("{} ({})", what, view.torque_unit);
}

}  // namespace warmjoint::figures

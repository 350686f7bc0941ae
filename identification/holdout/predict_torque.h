// The torque that a model predicts along a log, and the figures of that.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/friction.h>
#include <warmjoint/prepared_log.h>

#include <optional>

#include "identification/fit.h"
#include "models/friction/along_motion.h"

namespace warmjoint {

/// What acts on a joint, as far as a fit knows it: F + G + M a, Eqs. (5) and (20).
struct TorqueModel {
  Friction friction;
  std::optional<GravityModel> gravity;
  std::optional<double> inertia;  // kg.m^2 or kg
  std::optional<double> lag{};    // s, of the torque's way into the log, first order
};

struct TorquePrediction {
  Eigen::VectorXd torque;  // [N] as the log would hold it, N.m or N
  Selection known;         // of the samples asked for, those where the model knows its gravity
  Prediction friction;
};

/// Along the motion from its first sample on, from `start`. Inertia acts where the log has an
/// acceleration (PreparedLog::moving). asked: samples that are to be compared.
TorquePrediction PredictTorque(const TorqueModel& model, const LogSamples& measurements,
                               Selection asked, const ThermalStart& start);

/// What the fit knows of the torque, its lag on the way into the log too.
TorqueModel ModelOf(const Fit& fit);

/// Compares the torque that the fit's friction, gravity and inertia predict along a log with the samples that
/// `test` keeps; where the fit knows its gravity only in places, with those there. The prediction
/// runs from the first sample on, from `start`. Nothing where the fit gives no
/// friction or no sample is left.
std::optional<Metrics> Evaluate(const Fit& fit, const LogSamples& measurements, Selection test,
                                const ThermalStart& start);

}  // namespace warmjoint

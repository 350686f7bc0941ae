// The rows of a fit's table of parameters: their names, units and bounds, in one place.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/friction.h>
#include <warmjoint/recording.h>

#include <optional>
#include <string>
#include <vector>

#include "identification/fit.h"

namespace warmjoint {

/// The name of the which-th row with a role, of those whose names depend neither on the law nor on the
/// kind of gravity: heat (gain, time constant), start (of the which-th recording), jump, inertia, lag and delay.
std::string NameOf(Role role, int which = 0);

/// The law's parameters and, where there is one value more, load_gain. values: [d] or [d + 1] in the order of its table.
std::vector<FitParameter> LawParameters(const Law& law, const Eigen::VectorXd& values,
                                        const Measurements& measurements);

/// load_gain of a friction.
FitParameter LoadParameter(double value, const Measurements& measurements);

/// thermal_gain and thermal_time_constant, the latter by its logarithm.
std::vector<FitParameter> HeatParameters(const Thermal& thermal, const Measurements& measurements);

/// initial_energy: E(0), N.m or N.
FitParameter StartParameter(double energy, const Measurements& measurements);

/// A change of E that no logged loss explains, by its name (JumpNames). energy: N.m or N
FitParameter JumpParameter(std::string name, double energy, const Measurements& measurements);

/// gravity_sine and gravity_cosine, or gravity_offset; of `paired`, whose knots are many, rows
/// without an interval that reports leave out.
std::vector<FitParameter> GravityParameters(GravityKind kind, const Eigen::VectorXd& values,
                                            const Measurements& measurements);

/// inertia, M of Eq. (5).
FitParameter InertiaParameter(double value, const Measurements& measurements);

/// torque_lag: T of a first-order lag, s, by its logarithm.
FitParameter TorqueLagParameter(double time_constant, const Measurements& measurements);

/// torque_delay: by how much the torque is late against the motion, s.
FitParameter TorqueDelayParameter(double delay, const Measurements& measurements);

/// Appends rows to those of the fit's table.
void Append(const std::vector<FitParameter>& rows, Fit& fit);

/// The law with its values and load_gain, where there is one value more, and nothing else. values: [d] or [d + 1]
Friction FrictionOf(const Law& law, const Eigen::VectorXd& values,
                    const Measurements& measurements);

/// Gives a friction the value of a row of law, load or heat; of the two rows of heat, the time constant is the one whose
/// coordinate is the logarithm. Other rows change nothing.
void SetFriction(const FitParameter& row, double value, Friction& friction);

/// Fn's parameters of a fit's friction, as LawParameters takes them: load_gain after the law's where the fit has it.
std::vector<double> NominalValues(const Fit& fit);

/// The which-th parameter with such a role, or nullptr.
const EstimatedParameter* Find(Role role, const Estimate& estimate, int which = 0);

/// Its value, where the estimate has it.
std::optional<double> ValueOf(Role role, const Estimate& estimate);

/// The first parameter that is that part of a law's force, or nullptr.
const EstimatedParameter* Find(LawPart part, const Estimate& estimate);

}  // namespace warmjoint

// The rows of the table of unknowns: their names, units and bounds, in one place.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/friction.h>
#include <warmjoint/recording.h>

#include <optional>
#include <string>
#include <vector>

#include "identification/fit/fit.h"

namespace warmjoint {

/// The name of the which-th row with a role, of those whose names depend neither on the law nor on the
/// kind of gravity: gain, time constant, load, start (of the which-th recording), jump, inertia, lag and delay.
std::string NameOf(Role role, int which = 0);

/// What a joint's units are of.
struct JointUnits {
  JointKind joint = JointKind::rotary;
  std::string torque;  // "N.m", or "A" of a log with a current in place of the torque
};
inline JointUnits UnitsOf(const Measurements& m) { return {m.joint, m.torque_unit}; }

/// The row of a parameter that friction files, laws or the heat have in their tables.
Unknown UnknownOf(const ParameterInfo& info, Role role, const JointUnits& units);

/// The law's parameters and, where there is one more, load_gain. count: of the rows
std::vector<Unknown> LawUnknowns(const Law& law, Eigen::Index count, const JointUnits& units);
/// load_gain of a friction.
Unknown LoadUnknown(const JointUnits& units);
/// thermal_gain and thermal_time_constant, the latter by its logarithm.
std::vector<Unknown> HeatUnknowns(const JointUnits& units);
/// initial_energy: E(0), N.m or N.
Unknown StartUnknown(const JointUnits& units);
/// A change of E that no logged loss explains, by its name (JumpNames), N.m or N.
Unknown JumpUnknown(std::string name, const JointUnits& units);
/// gravity_sine and gravity_cosine, or gravity_offset; of `paired`, whose knots are many, rows that reports leave out.
std::vector<Unknown> GravityUnknowns(GravityKind kind, Eigen::Index count, const JointUnits& units);
/// inertia, M of Eq. (5).
Unknown InertiaUnknown(const JointUnits& units);
/// torque_lag: T of a first-order lag, s, by its logarithm.
Unknown LagUnknown(const JointUnits& units);
/// torque_delay: by how much the torque is late against the motion, s.
Unknown DelayUnknown(const JointUnits& units);

/// A row with its value.
Unknown WithValue(Unknown row, double value);
std::vector<Unknown> WithValues(const std::vector<Unknown>& rows, const Eigen::VectorXd& values);
/// The rows of a heat with its values.
std::vector<Unknown> HeatParameters(const Thermal& thermal, const Measurements& measurements);

/// Appends rows to those of the fit's table.
void Append(const std::vector<Unknown>& rows, Fit& fit);

/// The law with its values and load_gain, where there is one value more, and nothing else. values: [d] or [d + 1]
Friction FrictionOf(const Law& law, const Eigen::VectorXd& values,
                    const Measurements& measurements);

/// Gives the fit's model the values of its table: friction, E(0), gravity, inertia and delay.
void FollowTable(Fit& fit);

/// The which-th parameter with such a role, or nullptr.
const EstimatedParameter* Find(Role role, const Estimate& estimate, int which = 0);

/// Its value, where the estimate has it.
std::optional<double> ValueOf(Role role, const Estimate& estimate);

/// The first parameter that is that part of a law's force, or nullptr.
const EstimatedParameter* Find(LawPart part, const Estimate& estimate);

}  // namespace warmjoint

#include "identification/fit/fit_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "identification/fit/fit_data.h"
#include "models/friction/parameter_rows.h"
#include "models/friction/thermal.h"

namespace warmjoint {
namespace {

constexpr std::string_view kInertiaName = "inertia", kTorqueLagName = "torque_lag",
                           kTorqueDelayName = "torque_delay";

constexpr ParameterInfo kInertiaInfo{kInertiaName, "M", {"N.m.s^2/rad", "N.s^2/m", -1, 2}, 0,
                                     kInfinity,    0,   "torque over acceleration"};

constexpr ParameterInfo kTorqueLagInfo{kTorqueLagName,
                                       "T",
                                       {"s", "s", 0, 1},
                                       kSmallestPositive,
                                       kInfinity,
                                       0,
                                       "time constant of the torque's lag"};

constexpr ParameterInfo kTorqueDelayInfo{kTorqueDelayName,
                                         "d",
                                         {"s", "s", 0, 1},
                                         -kInfinity,
                                         kInfinity,
                                         0,
                                         "by how much the torque is late against the motion"};

/// The parameter's unit for the joint and its unit of torque: "A.s/rad" where the log has a current in place of the torque.
std::string UnitFor(const ParameterInfo& info, const JointUnits& units) {
  const std::string_view table = info.unit.For(units.joint);
  const std::string_view torque = kTorqueUnit.For(units.joint);
  if (units.torque == torque) return std::string(table);

  // the thermal gain is torque over torque times velocity
  if (table == kThermalGainUnit.For(units.joint)) {
    return units.joint == JointKind::rotary ? "s/rad" : "s/m";
  }

  // the log's unit of torque takes the place of the table's
  if (table.substr(0, torque.size()) != torque) return std::string(table);
  return units.torque + std::string(table.substr(torque.size()));
}

/// The row of load_gain, as friction files have it.
const ParameterInfo& LoadGainInfo() {
  return std::ranges::find(FrictionOptions(), &Friction::load_gain, &FrictionOption::value)->info;
}

}  // namespace

std::string NameOf(Role role, int which) {
  switch (role) {
    case Role::gain:
      return std::string(kGainName);
    case Role::time_constant:
      return std::string(kTimeConstantName);
    case Role::start:
      return which == 0 ? "initial_energy" : fmt::format("initial_energy_{}", which + 1);
    case Role::jump:
      return fmt::format("energy_jump_{}", which + 1);
    case Role::inertia:
      return std::string(kInertiaName);
    case Role::lag:
      return std::string(kTorqueLagName);
    case Role::delay:
      return std::string(kTorqueDelayName);
    case Role::load:
      return std::string(LoadGainInfo().name);
    default:
      break;
  }
  assert(false);
  return "";
}

Unknown UnknownOf(const ParameterInfo& info, Role role, const JointUnits& units) {
  return {.name = std::string(info.name),
          .role = role,
          .unit = UnitFor(info, units),
          .lower = info.lower,
          .upper = info.upper,
          .displacement_power = info.unit.displacement,
          .time_power = info.unit.time,
          .part = info.part};
}

std::vector<Unknown> LawUnknowns(const Law& law, Eigen::Index count, const JointUnits& units) {
  std::vector<Unknown> rows;
  for (const ParameterInfo& info : law.parameters) {
    rows.push_back(UnknownOf(info, Role::law, units));
  }
  if (count > std::ssize(rows)) rows.push_back(LoadUnknown(units));
  return rows;
}

Unknown LoadUnknown(const JointUnits& units) {
  return UnknownOf(LoadGainInfo(), Role::load, units);
}

std::vector<Unknown> HeatUnknowns(const JointUnits& units) {
  const auto& [gain, tau] = Thermal::parameters;
  std::vector<Unknown> rows{UnknownOf(gain, Role::gain, units),
                            UnknownOf(tau, Role::time_constant, units)};
  rows[1].coordinate = Coordinate::logarithm;
  return rows;
}

Unknown StartUnknown(const JointUnits& units) {
  return {.name = NameOf(Role::start), .role = Role::start, .unit = units.torque};
}

Unknown JumpUnknown(std::string name, const JointUnits& units) {
  return {.name = std::move(name), .role = Role::jump, .unit = units.torque};
}

std::vector<Unknown> GravityUnknowns(GravityKind kind, Eigen::Index count,
                                     const JointUnits& units) {
  Unknown row;
  row.role = Role::gravity;
  row.unit = units.torque;
  std::vector<Unknown> rows(static_cast<size_t>(count), row);
  if (kind == GravityKind::sincos) {
    rows[0].name = "gravity_sine";
    rows[1].name = "gravity_cosine";
  }
  if (kind == GravityKind::constant) rows[0].name = "gravity_offset";
  return rows;
}

Unknown InertiaUnknown(const JointUnits& units) {
  return UnknownOf(kInertiaInfo, Role::inertia, units);
}

Unknown LagUnknown(const JointUnits& units) {
  Unknown row = UnknownOf(kTorqueLagInfo, Role::lag, units);
  row.coordinate = Coordinate::logarithm;
  return row;
}

Unknown DelayUnknown(const JointUnits& units) {
  return UnknownOf(kTorqueDelayInfo, Role::delay, units);
}

Unknown WithValue(Unknown row, double value) {
  row.value = value;
  return row;
}

std::vector<Unknown> WithValues(const std::vector<Unknown>& rows, const Eigen::VectorXd& values) {
  std::vector<Unknown> table;
  for (const Unknown& row : rows) table.push_back(WithValue(row, values[std::ssize(table)]));
  return table;
}

std::vector<Unknown> HeatParameters(const Thermal& thermal, const Measurements& measurements) {
  return WithValues(HeatUnknowns(UnitsOf(measurements)),
                    Eigen::Vector2d{thermal.gain, thermal.time_constant});
}

void Append(const std::vector<Unknown>& rows, Fit& fit) {
  fit.parameters.insert(fit.parameters.end(), rows.begin(), rows.end());
}

Friction FrictionOf(const Law& law, const Eigen::VectorXd& values,
                    const Measurements& measurements) {
  Friction friction;
  friction.law = law.name;
  friction.gear = measurements.gear;
  for (size_t i = 0; i < law.parameters.size(); ++i) {
    friction.parameters[std::string(law.parameters[i].name)] = values[static_cast<Eigen::Index>(i)];
  }
  const auto d = std::ssize(law.parameters);
  if (values.size() > d) friction.load_gain = values[d];
  return friction;
}

void FollowTable(Fit& fit) {
  for (const Unknown& row : fit.parameters) {
    if (double* const place = row.PlaceIn(fit.model.friction)) *place = row.value;
    if (row.role == Role::start) fit.start.energy = row.value;
    if (row.role == Role::inertia) fit.model.inertia = row.value;
    if (row.role == Role::delay) fit.model.delay = row.value;
  }
  if (fit.rows.gravity.size() == 0) return;
  const std::vector<double> gravity = fit.Values(Role::gravity);
  fit.model.gravity->values =
      fit.rows.gravity * Eigen::Map<const Eigen::VectorXd>(gravity.data(), std::ssize(gravity));
}

const EstimatedParameter* Find(Role role, const Estimate& estimate, int which) {
  return estimate.Find(NameOf(role, which));
}

std::optional<double> ValueOf(Role role, const Estimate& estimate) {
  const EstimatedParameter* found = Find(role, estimate);
  return found ? std::optional(found->value) : std::nullopt;
}

const EstimatedParameter* Find(LawPart part, const Estimate& estimate) {
  const auto found =
      std::ranges::find(estimate.parameters, part,
                        [](const EstimatedParameter& parameter) { return PartOf(parameter.name); });
  return found == estimate.parameters.end() ? nullptr : &*found;
}

}  // namespace warmjoint

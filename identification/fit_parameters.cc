#include "identification/fit_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "identification/fit_data.h"
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

/// The parameter's unit for the recording's joint and torque unit: "A.s/rad" where the log has a current
/// in place of the torque.
std::string UnitFor(const ParameterInfo& info, const Measurements& measurements) {
  const std::string_view table = info.unit.For(measurements.joint);
  const std::string_view torque = kTorqueUnit.For(measurements.joint);
  if (measurements.torque_unit == torque) return std::string(table);

  // the thermal gain is torque over torque times velocity
  if (table == kThermalGainUnit.For(measurements.joint)) {
    return measurements.joint == JointKind::rotary ? "s/rad" : "s/m";
  }

  // the log's unit of torque takes the place of the table's
  if (table.substr(0, torque.size()) != torque) return std::string(table);
  return measurements.torque_unit + std::string(table.substr(torque.size()));
}

/// The row of load_gain, as friction files have it.
const ParameterInfo& LoadGainInfo() {
  return std::ranges::find(FrictionOptions(), &Friction::load_gain, &FrictionOption::value)->info;
}

/// A parameter of any table with its value.
FitParameter TableParameter(const ParameterInfo& info, Role role, double value,
                            const Measurements& measurements) {
  return {.name = std::string(info.name),
          .role = role,
          .value = value,
          .unit = UnitFor(info, measurements),
          .lower = info.lower,
          .upper = info.upper,
          .displacement_power = info.unit.displacement,
          .time_power = info.unit.time,
          .part = info.part};
}

}  // namespace

std::string NameOf(Role role, int which) {
  switch (role) {
    case Role::heat:
      return std::string(which == 0 ? kGainName : kTimeConstantName);
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
    case Role::law:
    case Role::gravity:
      break;
  }
  assert(false);
  return "";
}

std::vector<FitParameter> LawParameters(const Law& law, const Eigen::VectorXd& values,
                                        const Measurements& measurements) {
  std::vector<FitParameter> rows;
  for (size_t i = 0; i < law.parameters.size(); ++i) {
    const double value = values[static_cast<Eigen::Index>(i)];
    rows.push_back(TableParameter(law.parameters[i], Role::law, value, measurements));
  }
  const auto d = std::ssize(rows);
  if (values.size() > d) rows.push_back(LoadParameter(values[d], measurements));
  return rows;
}

FitParameter LoadParameter(double value, const Measurements& measurements) {
  return TableParameter(LoadGainInfo(), Role::load, value, measurements);
}

std::vector<FitParameter> HeatParameters(const Thermal& thermal, const Measurements& measurements) {
  const auto& [gain, tau] = Thermal::parameters;
  std::vector<FitParameter> rows{
      TableParameter(gain, Role::heat, thermal.gain, measurements),
      TableParameter(tau, Role::heat, thermal.time_constant, measurements)};
  // a time constant is fitted by its logarithm
  rows[1].coordinate = Coordinate::logarithm;
  return rows;
}

FitParameter StartParameter(double energy, const Measurements& measurements) {
  return {NameOf(Role::start), Role::start, energy, measurements.torque_unit};
}

FitParameter JumpParameter(std::string name, double energy, const Measurements& measurements) {
  return {std::move(name), Role::jump, energy, measurements.torque_unit};
}

std::vector<FitParameter> GravityParameters(GravityKind kind, const Eigen::VectorXd& values,
                                            const Measurements& measurements) {
  // coefficients of paired gravity have no names, so that no report lists them
  std::vector<std::string> names(static_cast<size_t>(values.size()));
  if (kind == GravityKind::sincos) names = {"gravity_sine", "gravity_cosine"};
  if (kind == GravityKind::constant) names = {"gravity_offset"};
  std::vector<FitParameter> rows;
  for (size_t i = 0; i < names.size(); ++i) {
    rows.push_back(
        {names[i], Role::gravity, values[static_cast<Eigen::Index>(i)], measurements.torque_unit});
  }
  return rows;
}

FitParameter InertiaParameter(double value, const Measurements& measurements) {
  return TableParameter(kInertiaInfo, Role::inertia, value, measurements);
}

FitParameter TorqueLagParameter(double time_constant, const Measurements& measurements) {
  FitParameter row = TableParameter(kTorqueLagInfo, Role::lag, time_constant, measurements);
  row.coordinate = Coordinate::logarithm;
  return row;
}

FitParameter TorqueDelayParameter(double delay, const Measurements& measurements) {
  return TableParameter(kTorqueDelayInfo, Role::delay, delay, measurements);
}

void Append(const std::vector<FitParameter>& rows, Fit& fit) {
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

void SetFriction(const FitParameter& row, double value, Friction& friction) {
  if (row.role == Role::law) friction.parameters[row.name] = value;
  if (row.role == Role::load) friction.load_gain = value;
  if (row.role != Role::heat) return;
  const bool gain = row.coordinate != Coordinate::logarithm;
  (gain ? friction.thermal->gain : friction.thermal->time_constant) = value;
}

std::vector<double> NominalValues(const Fit& fit) {
  std::vector<double> values = LawValues(fit.friction);
  if (fit.RowOf(Role::load)) values.push_back(fit.friction.load_gain);
  return values;
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

#include "scenarios/yaml_disturbances.h"

#include <cmath>

namespace warmjoint::inline scenarios {
namespace {

/// A number of a disturbance: where it stands and what it must satisfy.
struct Entry {
  std::string name;
  double* number;
  Bound bound;
  bool has_default = false;  // may be left out
};

/// A disturbance as the file names it; once it is named, its entries are required.
struct Part {
  std::string name;
  std::vector<Entry> entries;
};

/// Forces that no model holds.
std::vector<Part> PartsOf(HiddenForces& h) {
  return {
      {"backlash",
       {{"level", &h.backlash.level, Bound::any}, {"way", &h.backlash.way, Bound::not_negative}}},
      {"hysteresis",
       {{"level", &h.hysteresis.level, Bound::any}, {"way", &h.hysteresis.way, Bound::positive}}},
      {"memory",
       {{"slope", &h.memory.slope, Bound::any},
        {"time_constant", &h.memory.time_constant, Bound::positive}}},
      {"quadratic_drag", {{"coefficient", &h.quadratic_drag.coefficient, Bound::any}}},
      {"ripple",
       {{"amplitude", &h.ripple.amplitude, Bound::any},
        {"period", &h.ripple.period, Bound::positive}}},
      {"spring", {{"stiffness", &h.spring.stiffness, Bound::any}}},
      {"inertia", {{"inertia", &h.inertia.inertia, Bound::not_negative}}},
  };
}

/// Faults of sensors, clocks and files.
std::vector<Part> PartsOf(SensorFaults& s) {
  return {
      {"sensor_drift",
       {{"offset", &s.sensor_drift.offset, Bound::any, true},
        {"gain", &s.sensor_drift.gain, Bound::any, true}}},
      {"gain_step",
       {{"factor", &s.gain_step.factor, Bound::any},
        {"time", &s.gain_step.time, Bound::not_negative}}},
      {"clock",
       {{"factor", &s.clock.factor, Bound::positive, true},
        {"jitter", &s.clock.jitter, Bound::not_negative, true}}},
      {"column_scale",
       {{"position", &s.column_scale.position, Bound::any, true},
        {"velocity", &s.column_scale.velocity, Bound::any, true},
        {"torque", &s.column_scale.torque, Bound::any, true}}},
      {"stuck_position",
       {{"time", &s.stuck_position.time, Bound::not_negative},
        {"duration", &s.stuck_position.duration, Bound::not_negative}}},
      {"stuck_velocity",
       {{"time", &s.stuck_velocity.time, Bound::not_negative},
        {"duration", &s.stuck_velocity.duration, Bound::not_negative}}},
      {"stuck_torque",
       {{"time", &s.stuck_torque.time, Bound::not_negative},
        {"duration", &s.stuck_torque.duration, Bound::not_negative}}},
      {"clipped", {{"level", &s.clipped.level, Bound::not_negative}}},
      {"dead_band", {{"level", &s.dead_band.level, Bound::not_negative}}},
      {"torque_resolution", {{"resolution", &s.torque_resolution.resolution, Bound::not_negative}}},
      {"late_torque", {{"samples", &s.late_torque.samples, Bound::not_negative}}},
      {"cut_start", {{"time", &s.cut_start.time, Bound::not_negative}}},
      {"gap",
       {{"time", &s.gap.time, Bound::not_negative},
        {"duration", &s.gap.duration, Bound::not_negative}}},
      {"lost_samples", {{"fraction", &s.lost_samples.fraction, Bound::not_negative}}},
      {"restarted_clock", {}},
      {"unsigned_torque", {}},
      {"reversed_torque", {}},
      {"swapped_columns", {}},
      {"without_load", {}},
  };
}

/// What acts on the joint or its log by models of its own. heat: stands for disturbances.second_heat.
std::vector<Part> PartsOf(Disturbances& d, Thermal& heat) {
  return {
      {"outliers",
       {{"fraction", &d.outliers.fraction, Bound::not_negative},
        {"size", &d.outliers.size, Bound::not_negative},
        {"one_sided", &d.outliers.one_sided, Bound::not_negative, true}}},
      {"coloured_noise",
       {{"deviation", &d.coloured_noise.deviation, Bound::not_negative},
        {"correlation_time", &d.coloured_noise.correlation_time, Bound::positive}}},
      {"uneven_noise",
       {{"of_torque", &d.uneven_noise.of_torque, Bound::not_negative, true},
        {"of_speed", &d.uneven_noise.of_speed, Bound::not_negative, true}}},
      {"periodic_torque",
       {{"amplitude", &d.periodic_torque.amplitude, Bound::any},
        {"period", &d.periodic_torque.period, Bound::positive}}},
      {"gravity",
       {{"sine", &d.gravity.sine, Bound::any, true},
        {"cosine", &d.gravity.cosine, Bound::any, true}}},
      {"ambient_drift",
       {{"amplitude", &d.ambient_drift.amplitude, Bound::any},
        {"period", &d.ambient_drift.period, Bound::positive}}},
      {"ambient_temperature",
       {{"amplitude", &d.ambient_temperature.amplitude, Bound::any},
        {"period", &d.ambient_temperature.period, Bound::positive}}},
      {"load_change",
       {{"load", &d.load_change.load, Bound::any},
        {"gain", &d.load_change.gain, Bound::not_negative},
        {"period", &d.load_change.period, Bound::positive}}},
      {"torque_lag", {{"time_constant", &d.torque_lag.time_constant, Bound::not_negative}}},
      {"velocity_filter",
       {{"time_constant", &d.velocity_filter.time_constant, Bound::not_negative}}},
      {"stale_position", {{"samples", &d.stale_position.samples, Bound::not_negative}}},
      {"encoder", {{"resolution", &d.encoder.resolution, Bound::not_negative}}},
      {"hold_parity", {{"level", &d.hold_parity.level, Bound::any}}},
      {"step_in_time",
       {{"level", &d.step_in_time.level, Bound::any},
        {"time", &d.step_in_time.time, Bound::not_negative}}},
      {"run_in",
       {{"level", &d.run_in.level, Bound::any},
        {"time_constant", &d.run_in.time_constant, Bound::positive}}},
      {"without_velocity", {}},
      {"second_heat",
       {{"thermal_gain", &heat.gain, Bound::any},
        {"thermal_time_constant", &heat.time_constant, Bound::positive}}},
  };
}

/// The one table that reading and writing share.
std::vector<Part> Parts(Disturbances& d, Thermal& heat) {
  std::vector<Part> parts = PartsOf(d, heat);
  for (const std::vector<Part>& more : {PartsOf(d.hidden), PartsOf(d.faults)}) {
    parts.insert(parts.end(), more.begin(), more.end());
  }
  return parts;
}

/// Parts without entries, which are there or not.
bool* FlagOf(const std::string& part, Disturbances& d) {
  if (part == "without_velocity") return &d.without_velocity;
  if (part == "restarted_clock") return &d.faults.restarted_clock;
  if (part == "unsigned_torque") return &d.faults.unsigned_torque;
  if (part == "reversed_torque") return &d.faults.reversed_torque;
  if (part == "swapped_columns") return &d.faults.swapped_columns;
  if (part == "without_load") return &d.faults.without_load;
  return nullptr;
}

/// Refuses a number of a part that is not whole.
void RequireWhole(const YamlValue& value, const char* part, const char* entry, double number) {
  if (number == std::round(number)) return;
  Refuse(value.Find(part)->place(), "{}.{}.{} is {}; it must be a whole number", value.key(), part,
         entry, number);
}

/// Refuses a fraction of the samples that is all of them or more.
void RequireShare(const YamlValue& value, const char* part, double fraction) {
  if (fraction < 1) return;
  Refuse(value.Find(part)->place(), "{}.{}.fraction is {}; it must be below 1", value.key(), part,
         fraction);
}

void ReadPart(const YamlValue& value, const Part& part) {
  std::vector<std::string> names;
  for (const Entry& entry : part.entries) names.push_back(entry.name);
  value.RequireKeys(names);
  for (const Entry& entry : part.entries) {
    if (entry.has_default && !value.Find(entry.name)) continue;
    *entry.number = value.Require(entry.name, "give a number").Number(entry.bound);
  }
}

}  // namespace

Disturbances ReadDisturbances(const YamlValue& value) {
  Disturbances disturbances;
  // the parts that may stand here
  Thermal heat;
  const std::vector<Part> parts = Parts(disturbances, heat);
  std::vector<std::string> names;
  for (const Part& part : parts) names.push_back(part.name);
  value.RequireKeys(names);

  // numbers of the parts that are named, then those that are there or not
  for (const Part& part : parts) {
    if (const auto given = value.Find(part.name)) ReadPart(*given, part);
  }
  if (value.Find("second_heat")) disturbances.second_heat = heat;
  for (const Part& part : parts) {
    if (bool* flag = FlagOf(part.name, disturbances)) *flag = value.Find(part.name).has_value();
  }
  // what no bound of a single number says
  RequireWhole(value, "stale_position", "samples", disturbances.stale_position.samples);
  RequireWhole(value, "late_torque", "samples", disturbances.faults.late_torque.samples);
  if (disturbances.outliers.one_sided > 1) {
    Refuse(value.Find("outliers")->place(), "{}.outliers.one_sided is {}; it must be 0 or 1",
           value.key(), disturbances.outliers.one_sided);
  }
  RequireShare(value, "outliers", disturbances.outliers.fraction);
  RequireShare(value, "lost_samples", disturbances.faults.lost_samples.fraction);
  return disturbances;
}

std::string DisturbancesToYaml(const Disturbances& disturbances, const std::string& indent) {
  // the same table of what is written, and of no disturbance at all
  Disturbances written = disturbances;
  Disturbances nothing;
  Thermal heat = disturbances.second_heat.value_or(Thermal{});
  Thermal no_heat;
  const std::vector<Part> parts = Parts(written, heat);
  const std::vector<Part> absent = Parts(nothing, no_heat);

  // a part is written where any of its numbers differs from that of no disturbance
  std::string yaml;
  for (size_t i = 0; i < parts.size(); ++i) {
    const bool* const flag = FlagOf(parts[i].name, written);
    bool given = (flag && *flag) || (parts[i].name == "second_heat" && disturbances.second_heat);
    std::string entries;
    for (size_t j = 0; j < parts[i].entries.size(); ++j) {
      const double number = *parts[i].entries[j].number;
      given |= number != *absent[i].entries[j].number;
      entries +=
          fmt::format("{}{}: {}", entries.empty() ? "" : ", ", parts[i].entries[j].name, number);
    }
    if (given) yaml += fmt::format("{}{}: {{{}}}\n", indent, parts[i].name, entries);
  }
  return yaml;
}

}  // namespace warmjoint::inline scenarios

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

/// The one table that reading and writing share. heat: stands for disturbances.second_heat.
std::vector<Part> Parts(Disturbances& d, Thermal& heat) {
  return {
      {"outliers",
       {{"fraction", &d.outliers.fraction, Bound::not_negative},
        {"size", &d.outliers.size, Bound::not_negative}}},
      {"coloured_noise",
       {{"deviation", &d.coloured_noise.deviation, Bound::not_negative},
        {"correlation_time", &d.coloured_noise.correlation_time, Bound::positive}}},
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
  Thermal heat;
  const std::vector<Part> parts = Parts(disturbances, heat);
  std::vector<std::string> names;
  for (const Part& part : parts) names.push_back(part.name);
  value.RequireKeys(names);

  for (const Part& part : parts) {
    if (const auto given = value.Find(part.name)) ReadPart(*given, part);
  }
  if (value.Find("second_heat")) disturbances.second_heat = heat;
  disturbances.without_velocity = value.Find("without_velocity").has_value();
  const double late = disturbances.stale_position.samples;
  if (late != std::round(late)) {
    Refuse(value.Find("stale_position")->place(),
           "{}.stale_position.samples is {}; it must be a whole number", value.key(), late);
  }
  if (disturbances.outliers.fraction >= 1) {
    Refuse(value.Find("outliers")->place(), "{}.outliers.fraction is {}; it must be below 1",
           value.key(), disturbances.outliers.fraction);
  }
  return disturbances;
}

std::string DisturbancesToYaml(const Disturbances& disturbances, const std::string& indent) {
  Disturbances written = disturbances;
  Disturbances nothing;
  Thermal heat = disturbances.second_heat.value_or(Thermal{});
  Thermal no_heat;
  const std::vector<Part> parts = Parts(written, heat);
  const std::vector<Part> absent = Parts(nothing, no_heat);

  std::string yaml;
  for (size_t i = 0; i < parts.size(); ++i) {
    bool given = (parts[i].name == "second_heat" && disturbances.second_heat) ||
                 (parts[i].name == "without_velocity" && disturbances.without_velocity);
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

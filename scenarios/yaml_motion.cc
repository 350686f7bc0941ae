#include "scenarios/yaml_motion.h"

#include <fmt/ranges.h>

#include "scenarios/yaml_choice.h"
#include "scenarios/yaml_distribution.h"

namespace warmjoint::inline scenarios {
namespace {

const Choices<SegmentOrder>& Orders() {
  static const Choices<SegmentOrder> orders{{"alternating", SegmentOrder::alternating},
                                            {"shuffled", SegmentOrder::shuffled},
                                            {"in_order", SegmentOrder::in_order}};
  return orders;
}

void ReadSpeeds(const YamlValue& value, Motion& motion) {
  if (IsDistribution(value)) {
    motion.speed_draws = ReadDistribution(value, Bound::not_negative);
    return;
  }
  for (const YamlValue& speed : value.List(
           "a list of speeds, for example [0.1, 1], or a distribution as {uniform: [0.1, 1]}")) {
    motion.speed_list.push_back(speed.Number(Bound::positive));
  }
}

/// Exactly one of hold and travel.
void ReadEnds(const YamlValue& value, Motion& motion) {
  const auto hold = value.Find("hold");
  const auto travel = value.Find("travel");
  if (hold && travel) {
    Refuse(travel->place(), "{} stands beside {}; keep one: hold speeds for a time, or travel",
           travel->key(), hold->key());
  }
  if (!hold && !travel) {
    Refuse(value.place(),
           "{} has neither hold nor travel; give hold: seconds, or travel: [lower, upper] or "
           "joint_limits",
           value.key());
  }
  if (hold) {
    motion.hold = hold->Number(Bound::positive);
  } else if (travel->IsScalar() && travel->Text() == "joint_limits") {
    motion.travel_between_joint_limits = true;
  } else {
    motion.travel = travel->Interval();
  }
}

/// A motion without phases; its keys have been checked.
Motion ReadSteadyMotion(const YamlValue& value) {
  Motion motion;
  ReadSpeeds(value.Require("speeds", "give a list of speeds or a distribution"), motion);
  ReadEnds(value, motion);
  if (const auto order = value.Find("order")) motion.order = ReadChoice(*order, Orders());
  if (const auto rests = value.Find("rests")) {
    rests->RequireKeys({"run", "rest"});
    motion.rests = Rests{
        rests->Require("run", "give the seconds of motion before a rest").Number(Bound::positive),
        rests->Require("rest", "give the seconds of a rest").Number(Bound::positive)};
  }
  return motion;
}

std::string SteadyMotionToYaml(const Motion& motion, const std::string& indent) {
  std::string yaml;
  const auto add = [&](std::string_view key, const std::string& value) {
    yaml += fmt::format("{}{}: {}\n", indent, key, value);
  };
  add("speeds", motion.speed_draws ? DistributionToYaml(*motion.speed_draws)
                                   : fmt::format("{}", motion.speed_list));
  if (motion.travel_between_joint_limits) {
    add("travel", "joint_limits");
  } else if (motion.travel) {
    add("travel", fmt::format("[{}, {}]", motion.travel->first, motion.travel->second));
  } else {
    add("hold", fmt::format("{}", motion.hold));
  }
  add("order", ChoiceName(motion.order, Orders()));
  if (motion.rests) {
    add("rests", fmt::format("{{run: {}, rest: {}}}", motion.rests->run, motion.rests->rest));
  }
  return yaml;
}

/// One entry of phases: {rest: s}, or a motion with its duration.
MotionPhase ReadPhase(const YamlValue& value) {
  if (value.IsMap() && value.Find("rest")) {
    value.RequireKeys({"rest"});
    return {value.Find("rest")->Number(Bound::positive), std::nullopt};
  }
  value.RequireKeys({"duration", "speeds", "hold", "order", "rests"});
  const double duration =
      value.Require("duration", "give the seconds of the phase").Number(Bound::positive);
  return {duration, ReadSteadyMotion(value)};
}

std::string CornersToYaml(const std::vector<VelocityCorner>& corners) {
  std::string yaml;
  for (const VelocityCorner& corner : corners) {
    yaml += fmt::format("{}[{}, {}]", yaml.empty() ? "[" : ", ", corner.time, corner.velocity);
  }
  return yaml + "]";
}

/// {corners: [[time, velocity], ...], start: position}.
Motion ReadCorners(const YamlValue& value, const YamlValue& corners) {
  value.RequireKeys({"corners", "start"});
  Motion motion;
  for (const YamlValue& entry : corners.List("a list of [time, velocity]")) {
    const std::vector<YamlValue> pair = entry.List("[time, velocity]");
    if (pair.size() != 2) entry.RefuseValue("[time, velocity]");
    const VelocityCorner corner{pair[0].Number(Bound::not_negative), pair[1].Number()};
    if (!motion.corners.empty() && !(corner.time > motion.corners.back().time)) {
      Refuse(entry.place(), "corner at {} s follows one at {} s; times must ascend", corner.time,
             motion.corners.back().time);
    }
    motion.corners.push_back(corner);
  }
  if (const auto start = value.Find("start")) motion.start = start->Number();
  return motion;
}

}  // namespace

Motion ReadMotion(const YamlValue& value) {
  const auto corners = value.IsMap() ? value.Find("corners") : std::nullopt;
  if (corners) return ReadCorners(value, *corners);
  const auto phases = value.IsMap() ? value.Find("phases") : std::nullopt;
  if (!phases) {
    value.RequireKeys({"speeds", "hold", "travel", "order", "rests", "phases", "corners"});
    return ReadSteadyMotion(value);
  }
  value.RequireKeys({"phases"});
  Motion motion;
  for (const YamlValue& phase : phases->List("a list of motions with a duration, and of rests")) {
    motion.phases.push_back(ReadPhase(phase));
  }
  return motion;
}

std::string MotionToYaml(const Motion& motion, const std::string& indent) {
  if (!motion.corners.empty()) {
    return fmt::format("{0}corners: {1}\n{0}start: {2}\n", indent, CornersToYaml(motion.corners),
                       motion.start);
  }
  if (motion.phases.empty()) return SteadyMotionToYaml(motion, indent);
  std::string yaml = indent + "phases:\n";
  for (const MotionPhase& phase : motion.phases) {
    if (!phase.motion) {
      yaml += fmt::format("{}  - {{rest: {}}}\n", indent, phase.duration);
      continue;
    }
    yaml += fmt::format("{}  - duration: {}\n{}", indent, phase.duration,
                        SteadyMotionToYaml(*phase.motion, indent + "    "));
  }
  return yaml;
}

}  // namespace warmjoint::inline scenarios

#include "scenarios/yaml_motion.h"

#include <fmt/ranges.h>

#include <cmath>

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
  // drawn anew for each segment, or a list
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
  // how long a speed lasts: one of both
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
  // breaks that interrupt the motion
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
  // what ends a segment
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
  // corners in order of time
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

/// {period, harmonics, speed}, and the position at which it begins.
Motion ReadFourier(const YamlValue& value, const YamlValue& fourier) {
  value.RequireKeys({"fourier", "start"});
  fourier.RequireKeys({"period", "harmonics", "speed"});
  const auto number = [&](const char* key, const char* what) {
    return fourier.Require(key, what).Number(Bound::positive);
  };
  const FourierMotion made{number("period", "give the seconds after which it repeats itself"),
                           number("harmonics", "give the number of harmonics, as 5"),
                           number("speed", "give the largest speed, rad/s or m/s")};
  // harmonics are counted
  if (made.harmonics != std::floor(made.harmonics) || made.harmonics > 1000) {
    fourier.Find("harmonics")->RefuseValue("a whole number up to 1000");
  }
  Motion motion;
  motion.fourier = made;
  if (const auto start = value.Find("start")) motion.start = start->Number();
  return motion;
}

/// {between: [lower, upper], speed, acceleration, pause}.
Motion ReadMoves(const YamlValue& value, const YamlValue& moves) {
  value.RequireKeys({"moves"});
  moves.RequireKeys({"between", "speed", "acceleration", "pause"});
  const auto number = [&](const char* key, const char* what) {
    return moves.Require(key, what).Number(Bound::positive);
  };
  MovesBetween made;
  made.between = moves.Require("between", "give [lower, upper], rad or m").Interval();
  made.speed = number("speed", "give the largest speed, rad/s or m/s");
  made.acceleration = number("acceleration", "give that of the ramps, rad/s^2 or m/s^2");
  if (const auto pause = moves.Find("pause")) made.pause = pause->Number(Bound::not_negative);
  Motion motion;
  motion.moves = made;
  return motion;
}

}  // namespace

Motion ReadMotion(const YamlValue& value) {
  // each kind of motion is known by a key of its own
  const auto corners = value.IsMap() ? value.Find("corners") : std::nullopt;
  if (corners) return ReadCorners(value, *corners);
  if (const auto fourier = value.IsMap() ? value.Find("fourier") : std::nullopt) {
    return ReadFourier(value, *fourier);
  }
  if (const auto moves = value.IsMap() ? value.Find("moves") : std::nullopt) {
    return ReadMoves(value, *moves);
  }
  const auto phases = value.IsMap() ? value.Find("phases") : std::nullopt;
  if (!phases) {
    value.RequireKeys(
        {"speeds", "hold", "travel", "order", "rests", "phases", "corners", "fourier", "moves"});
    return ReadSteadyMotion(value);
  }

  // phases, each steady motion or rest
  value.RequireKeys({"phases"});
  Motion motion;
  for (const YamlValue& phase : phases->List("a list of motions with a duration, and of rests")) {
    motion.phases.push_back(ReadPhase(phase));
  }
  return motion;
}

std::string MotionToYaml(const Motion& motion, const std::string& indent) {
  // kinds of motion with a key of their own
  if (!motion.corners.empty()) {
    return fmt::format("{0}corners: {1}\n{0}start: {2}\n", indent, CornersToYaml(motion.corners),
                       motion.start);
  }
  if (motion.fourier) {
    const auto& [period, harmonics, speed] = *motion.fourier;
    return fmt::format("{0}fourier: {{period: {1}, harmonics: {2}, speed: {3}}}\n{0}start: {4}\n",
                       indent, period, harmonics, speed, motion.start);
  }
  if (motion.moves) {
    const auto& [between, speed, acceleration, pause] = *motion.moves;
    return fmt::format("{}moves: {{between: [{}, {}], speed: {}, acceleration: {}, pause: {}}}\n",
                       indent, between.first, between.second, speed, acceleration, pause);
  }

  // phases, or a single motion
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

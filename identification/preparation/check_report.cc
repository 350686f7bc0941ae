#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "identification/preparation/check.h"

namespace warmjoint {
namespace {

using nlohmann::json;

std::string SamplingLine(const SamplingCheck& sampling) {
  const std::string gaps = sampling.gaps == 0
                               ? "no gaps"
                               : fmt::format("{} gap{}, the longest {:.3g} s", sampling.gaps,
                                             sampling.gaps == 1 ? "" : "s", sampling.longest_gap);
  return fmt::format(
      "sampling    {} samples in {:.4g} s, {:.4g} Hz, jitter {:.1f} % of a step, {}\n",
      sampling.samples, sampling.duration, sampling.rate, 100 * sampling.jitter, gaps);
}

/// A line with the turns of the joint, which a person can judge at a glance. Why: where both columns are in degrees, nothing else shows it.
std::string TurnsLine(const RecordingCheck& check) {
  if (check.joint != JointKind::rotary || check.motion.levels.empty()) return "";
  constexpr double turn = 2 * std::numbers::pi;  // rad
  double fastest = 0;
  for (const SpeedLevel& level : check.motion.levels) {
    fastest = std::max(fastest, std::abs(level.velocity));
  }
  return fmt::format("            {:.4g} rev/min at most, over {:.4g} turns\n", fastest / turn * 60,
                     (check.motion.upper - check.motion.lower) / turn);
}

std::string MotionLine(const MotionCheck& motion, std::string_view length_unit) {
  return fmt::format(
      "motion      {:.1f} % of the samples at a constant speed, in {} segments; {:.1f} % at rest\n"
      "{}travel      {:.4g} to {:.4g} {}\n",
      100 * motion.constant_share, motion.segments, 100 * motion.rest_share,
      motion.holds_speeds
          ? ""
          : fmt::format("            fits take motion of any kind: {} samples, with inertia\n",
                        motion.fitted),
      motion.lower, motion.upper, length_unit);
}

/// "positive    16 segments: 8 at 0.0421, 4 at 0.0826, 4 at 0.125 m/s", "negative    1 segment, at 0.5 rad/s"
std::string DirectionLine(const MotionCheck& motion, int sign, std::string_view unit) {
  constexpr std::size_t most = 12;  // speeds listed
  // levels of this direction, those of negative speed turned so that the slowest comes first
  int segments = 0;
  std::vector<std::string> speeds, parts;
  for (const SpeedLevel& level : motion.levels) {
    if (sign * level.velocity <= 0) continue;
    segments += level.segments;
    speeds.push_back(fmt::format("{:.3g}", std::abs(level.velocity)));
    parts.push_back(fmt::format("{} at {}", level.segments, speeds.back()));
  }
  // the slowest first
  if (sign < 0) {
    std::ranges::reverse(speeds);
    std::ranges::reverse(parts);
  }

  // as many words as there are speeds
  const std::string name = sign > 0 ? "positive" : "negative";
  if (segments == 0) return fmt::format("{}    none\n", name);
  const std::string counted =
      fmt::format("{}    {} segment{}", name, segments, segments == 1 ? "" : "s");
  if (speeds.size() == 1) return fmt::format("{}, at {} {}\n", counted, speeds.front(), unit);
  if (speeds.size() <= most)
    return fmt::format("{}: {} {}\n", counted, fmt::join(parts, ", "), unit);
  return fmt::format("{} at {} speeds from {} to {} {}\n", counted, speeds.size(), speeds.front(),
                     speeds.back(), unit);
}

/// The command that makes a motion with law and warming in it, within what this log reaches; "" where this one shows them.
std::string DesignLine(const RecordingCheck& check) {
  const auto lacks = [](const Excitation& one) {
    const bool is_of_motion = one.kind == FrictionKind::coulomb ||
                              one.kind == FrictionKind::viscous_coulomb ||
                              one.kind == FrictionKind::warm_up;
    return is_of_motion && !one.sufficient;
  };
  if (std::ranges::none_of(check.excitation, lacks)) return "";
  double fastest = 0;
  for (const SpeedLevel& level : check.motion.levels) {
    fastest = std::max(fastest, std::abs(level.velocity));
  }
  std::string limits;
  if (check.motion.upper > check.motion.lower && fastest > 0) {
    limits = fmt::format(" --limits position={:.3g}..{:.3g},velocity={:.3g}", check.motion.lower,
                         check.motion.upper, fastest);
  }
  return fmt::format(
      "to record   `warmjoint design{} --minutes 20 -o motion` makes a motion that shows law and "
      "warming\n",
      limits);
}

}  // namespace

std::string CheckToText(const RecordingCheck& check) {
  const std::string_view speed_unit = kVelocityUnit.For(check.joint);
  // what was recorded, and what the motion shows
  std::string text = fmt::format("recording   {}: {} joint, torque in {}\n", check.source,
                                 NameOf(check.joint), check.torque_unit);
  for (const std::string& note : check.notes) text += fmt::format("            {}\n", note);
  text += SamplingLine(check.sampling);
  text += MotionLine(check.motion, kPositionUnit.For(check.joint));
  text += TurnsLine(check);
  text += DirectionLine(check.motion, 1, speed_unit);
  text += DirectionLine(check.motion, -1, speed_unit);
  // the noise or resolution of the velocity; a velocity that was smoothed from rounded positions has no noise to report
  if (check.motion.position_resolution > 0) {
    text += fmt::format("resolution  the position comes in steps of {:.3g} {}",
                        check.motion.position_resolution, kPositionUnit.For(check.joint));
  } else {
    text += fmt::format("noise       {:.2g} {} around constant speeds", check.motion.speed_noise,
                        speed_unit);
    if (check.motion.speed_resolution > 0) {
      text += fmt::format("; velocity comes in steps of {:.3g}", check.motion.speed_resolution);
    }
  }
  text += "\n";
  // faults, then each kind of friction with the reason for the verdict
  for (const std::string& fault : check.faults) text += fmt::format("fault       {}\n", fault);
  text += check.faults.empty() ? "can be identified\n" : "could be identified without the faults\n";
  for (const Excitation& excitation : check.excitation) {
    text += fmt::format("  {:<4}{}: {}\n", excitation.sufficient ? "yes" : "no", excitation.what,
                        excitation.reason);
  }
  return text + DesignLine(check);
}

json CheckToJson(const RecordingCheck& check) {
  const SamplingCheck& sampling = check.sampling;
  const MotionCheck& motion = check.motion;
  // lists of the speed levels and of the verdicts
  json levels = json::array();
  for (const SpeedLevel& level : motion.levels) {
    levels.push_back(
        {{"velocity", level.velocity}, {"segments", level.segments}, {"samples", level.samples}});
  }
  json excitation = json::array();
  for (const Excitation& each : check.excitation) {
    excitation.push_back(
        {{"what", each.what}, {"sufficient", each.sufficient}, {"reason", each.reason}});
  }
  return {{"source", check.source},
          {"joint", NameOf(check.joint)},
          {"torque_unit", check.torque_unit},
          {"notes", check.notes},
          {"sampling",
           {{"samples", sampling.samples},
            {"duration", sampling.duration},
            {"step", sampling.step},
            {"rate", sampling.rate},
            {"jitter", sampling.jitter},
            {"gaps", sampling.gaps},
            {"longest_gap", sampling.longest_gap}}},
          {"motion",
           {{"constant_share", motion.constant_share},
            {"rest_share", motion.rest_share},
            {"segments", motion.segments},
            {"holds_speeds", motion.holds_speeds},
            {"fitted", motion.fitted},
            {"levels", levels},
            {"travel", {motion.lower, motion.upper}},
            {"speed_noise", motion.speed_noise},
            {"speed_resolution", motion.speed_resolution},
            {"position_resolution", motion.position_resolution}}},
          {"faults", check.faults},
          {"excitation", excitation}};
}

}  // namespace warmjoint

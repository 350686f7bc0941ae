#include "identification/sentences/log.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <warmjoint/friction.h>

namespace warmjoint {

std::string ExplainFaults(const std::vector<std::string>& faults) {
  return fmt::format("{}", fmt::join(faults, "; and "));
}

std::string ExplainAveraging(const VelocityNoise& taken, JointKind joint, std::string_view slope) {
  const std::string_view unit = kVelocityUnit.For(joint);
  if (slope.empty()) {
    return fmt::format("velocity averaged over each segment, for its noise of {:.2g} {}",
                       taken.noise, unit);
  }
  return fmt::format(
      "velocity averaged over each segment, since its noise of {:.2g} {} would change {} by {:.2g} "
      "%",
      taken.noise, unit, slope, -100 * taken.attenuation);
}

std::string ExplainVelocityNoise(const VelocityNoise& taken, std::string_view slope) {
  return fmt::format(
      "the noise of the velocity may still change {} by {:.2g} %, and intervals were widened to "
      "cover this; hold each speed for longer, or log a finer position",
      slope, -100 * taken.left);
}

std::string ExplainReversals(double unseen) {
  return fmt::format(
      "reversals happen between two samples: if the drive reverses slowly, the joint travelled up "
      "to {:.1f} % less than assumed, and thermal_gain is too small by as much; log faster to see "
      "the reversals",
      100 * unseen);
}

std::string ExplainRounding(double step, const std::string& unit, const MovedParameter& moved,
                            Action action) {
  const bool shifts = action == Action::shift;
  return fmt::format(
      "the torque comes in steps of {:.3g} {}, which its noise does not even out: {} {} by {:.2g} "
      "{}; log the torque in finer steps",
      step, unit,
      shifts ? "the numbers given are free of what they do,"
             : "intervals were widened to cover what they hide, that of",
      moved.parameter.name + (shifts ? " changed" : ""), moved.change, moved.parameter.unit);
}

std::string ExplainFewSamples(double used, double moving, double fewest, double least_share,
                              MotionKind motion) {
  const std::string others = motion == MotionKind::chosen
                                 ? ""
                                 : fmt::format(", or use the others (--motion {})",
                                               motion == MotionKind::any ? "constant" : "any");
  return fmt::format(
      "the fit rests on {} of {} samples that move, and takes {} and {:.0f} % of them: record "
      "longer{}",
      used, moving, fewest, 100 * least_share, others);
}

std::string ExplainOneSpeed(const std::vector<std::string>& names,
                            const std::vector<double>& speeds, const std::string& unit) {
  std::vector<std::string> at;
  for (const double speed : speeds) at.push_back(fmt::format("{:.3g}", speed));
  return fmt::format(
      "the log moves at one speed each way: {} {} the friction at {} {}, of which any part may be "
      "viscous; record other speeds, too",
      fmt::join(names, " and "), names.size() > 1 ? "are" : "is", fmt::join(at, " and "), unit);
}

}  // namespace warmjoint

#include "identification/report/tell_preparation.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "identification/find_parameter.h"
#include "models/friction/law.h"

namespace warmjoint {
namespace {

constexpr double kHarmless = 1e-3;    // attenuation
constexpr double kUnseenPath = 5e-3;  // share of the path

void TellReversals(double unseen, Estimate& estimate) {
  if (unseen < kUnseenPath || !Find(Role::heat, estimate)) return;
  estimate.warnings.push_back(
      fmt::format("reversals happen between two samples: if the drive reverses slowly, the joint "
                  "travelled up to {:.1f} % less than assumed, and thermal_gain is too small by as "
                  "much; log faster to see the reversals",
                  100 * unseen));
}

/// What of an estimate slopes over speed, for noise of the velocity to change; empty: nothing does.
std::string_view SlopeOf(const Estimate& estimate) {
  if (const EstimatedParameter* slope = Find(LawPart::slope, estimate)) return slope->name;
  if (!estimate.friction) return "";
  // maps over the velocity, and those that it multiplies, have slopes, too
  for (const FrictionMap& map : estimate.friction->maps) {
    if (FindAxis(map, MapQuantity::velocity)) return "slopes over speed";
    if (map.factor == MapFactor::velocity) return "slopes over speed";
  }
  return "";
}

}  // namespace

void TellVelocity(const VelocityNoise& taken, JointKind joint, Estimate& estimate) {
  const std::string_view slope = SlopeOf(estimate);
  // nothing slopes over speed: the averaging is told, and no more
  if (slope.empty()) {
    estimate.message +=
        fmt::format("; velocity averaged over each segment, for its noise of {:.2g} {}",
                    taken.noise, kVelocityUnit.For(joint));
    return;
  }

  // how far the noise would have moved the slope
  const EstimatedParameter* viscous = Find(LawPart::slope, estimate);
  estimate.message += fmt::format(
      "; velocity averaged over each segment, since its noise of {:.2g} {} would change {} by "
      "{:.2g} %",
      taken.noise, kVelocityUnit.For(joint), slope, -100 * taken.attenuation);

  // what averaging left of that: a warning, and wider intervals
  if (taken.left <= kHarmless) return;
  estimate.warnings.push_back(
      fmt::format("the noise of the velocity may still change {} by {:.2g} %, and intervals were "
                  "widened to cover this; hold each speed for longer, or log a finer position",
                  slope, -100 * taken.left));
  if (!viscous) return;

  // a slope that is off moves the levels by as much as it takes at the mean speed
  const double move = std::abs(taken.left * viscous->value);
  for (EstimatedParameter& parameter : estimate.parameters) {
    const LawPart part = PartOf(parameter.name);
    const bool is_level = part == LawPart::level;
    if (!parameter.interval95 || !(is_level || part == LawPart::slope)) continue;
    const double reach = is_level ? move * taken.mean_speed : move;
    (*parameter.interval95)[0] -= reach;
    (*parameter.interval95)[1] += reach;
  }
}

void TellPreparation(const PreparedLog& log, Estimate& estimate) {
  TellReversals(log.unseen(), estimate);
  for (const std::string& warning : log.warnings()) estimate.warnings.push_back(warning);
  if (estimate.status != Status::ok || !log.velocity_noise()) return;
  TellVelocity(*log.velocity_noise(), log.taken().measurements.joint, estimate);
}

}  // namespace warmjoint

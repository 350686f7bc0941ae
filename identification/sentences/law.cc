#include "identification/sentences/law.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "identification/command.h"
#include "models/friction/laws.h"
#include "models/friction/parameter_rows.h"

namespace warmjoint {
namespace {

/// "viscous is -0.3 N.m.s/rad, below its bound 0, with its whole 95 % interval, -0.4 to -0.2".
std::string Describe(const Excess& excess) {
  const auto& interval = excess.interval95;
  const std::string reach =
      !interval ? ", with no interval that could tell whether by chance"
                : fmt::format(", {} 95 % interval, {:.3g} to {:.3g}",
                              excess.beyond ? "with its whole" : "but for a part of its",
                              (*interval)[0], (*interval)[1]);
  return fmt::format("{} is {:.4g} {}, {} its bound {}{}", excess.parameter.name,
                     excess.parameter.value, excess.parameter.unit,
                     excess.below ? "below" : "above", excess.bound, reach);
}

bool Warms(const Fit& fit) { return fit.RowOf(Role::gain).has_value(); }

/// The identifier of the linear laws with warming or without, as a fit has it.
std::string_view LinearLike(const Fit& fit) { return Warms(fit) ? "energy-ml" : "nominal-ls"; }

/// What to try against friction that falls with speed: what the fit has of curve and warming is not
/// named again.
std::string RemedyForFallingSlope(const Fit& fit) {
  const std::string& law = fit.model.friction.law;
  // whether the law has a Stribeck curve already
  const bool curved =
      fit.model.friction.parameters.contains(std::string(kStribeckVelocityRow.name));
  const bool warms = Warms(fit);
  if (curved && warms) {
    return "friction falls with speed beyond the law's curve and its warming: record higher speeds";
  }
  if (curved || warms) {
    return fmt::format("friction that falls with speed {}: try --identifier {}",
                       curved ? "beyond the law's curve is warming" : "is a Stribeck effect",
                       CurveCommand(law, "estimated").Text());
  }
  return fmt::format(
      "friction that falls with speed is warming, or a Stribeck effect: try --identifier {}, or "
      "--identifier {} where the joint does not warm",
      LinearCommand("energy-ml", law).Text(), CurveCommand(law, "none").Text());
}

/// What makes a fit leave its bounds, and what to try.
std::string RemedyForBound(const Unknown& parameter, const Fit& fit) {
  if (parameter.part == LawPart::slope) return RemedyForFallingSlope(fit);
  // neither slope nor level: a linear law may do without it
  if (parameter.part != LawPart::level) {
    return fmt::format("try --identifier {}",
                       LinearCommand(LinearLike(fit), fit.model.friction.law).Text());
  }
  // gravity is fitted already, which leaves the sign as a cause
  const std::string torque = fit.model.gravity
                                 ? "is the sign of the torque"
                                 : fmt::format(
                                       "does the torque hold gravity or another load (try "
                                       "--identifier {} --gravity paired), or is its sign",
                                       LinearLike(fit));
  return fmt::format("a negative level would push the joint: {} reversed (--scale torque=-1)?",
                     torque);
}

}  // namespace

std::string ExplainHeld(const std::vector<Excess>& held) {
  std::vector<std::string> words;
  for (const Excess& one : held) {
    words.push_back(
        fmt::format("{}: noise may do that, so it is set to {}", Describe(one), one.bound));
  }
  return fmt::format("{}", fmt::join(words, "; and "));
}

std::string ExplainExcess(const Excess& excess, const Fit& fit) {
  return fmt::format("{}: law {} does not describe these data; {}", Describe(excess),
                     fit.model.friction.law, RemedyForBound(excess.parameter, fit));
}

std::string ExplainRiseFromRest(const Fit& fit) {
  const std::string& law = fit.model.friction.law;
  return fmt::format(
      "{}: friction rises from rest with speed, where law {} lets it fall; try --identifier {} "
      "--set law={}",
      fit.model.friction.parameters.contains(std::string(kStaticRiseRow.name))
          ? "static_rise is below 0"
          : "static is below coulomb",
      law, LinearLike(fit), HasLevelForEachDirection(law) ? "asymmetric" : "viscous_coulomb");
}

std::string ExplainMixedColumns(const MixedColumns& mixed) {
  // what is mixed, in words
  std::vector<std::string> parts;
  if (!mixed.names.empty()) parts.push_back(fmt::format("{}", fmt::join(mixed.names, ", ")));
  if (mixed.gravity) parts.push_back(fmt::format("gravity ({})", NameOf(*mixed.gravity)));
  if (mixed.has_inertia) parts.emplace_back("inertia");

  // and the motion that distinguishes them
  const bool turns = mixed.gravity && mixed.gravity != GravityKind::constant;
  return fmt::format(
      "the motion does not distinguish: {}; {}at two or more speeds in both directions{}, or use a "
      "law that is alike in both directions, as viscous_coulomb",
      fmt::join(parts, " and "), turns ? "move over a larger part of a turn, " : "move ",
      mixed.has_inertia ? ", with accelerations that differ" : "");
}

std::string ExplainFewPairs(const PairedSamples& found, const PairedSamples& needed) {
  return fmt::format(
      "gravity paired: only {:.3g} % of the samples, over {:.2g} rad, were also passed in the "
      "other direction; at least {:.0f} % over {:.2g} rad are needed. Sweep one range in both "
      "directions, or use gravity sincos",
      100 * found.share, found.range, 100 * needed.share, needed.range);
}

}  // namespace warmjoint

#include "identification/sentences/falls.h"

#include <fmt/format.h>

namespace warmjoint {
namespace {

/// known: what the samples around reversals do
std::string ExplainStiffness(std::string_view known) {
  return fmt::format(
      "bristle_stiffness and bristle_damping cannot be estimated: the samples around reversals {}; "
      "reverse slowly and over small distances, so that several samples fall between standstill "
      "and sliding, or try --identifier stribeck",
      known);
}

}  // namespace

std::string ExplainSlowSpeeds(double slowest, double aim, JointKind joint) {
  const std::string_view unit = kVelocityUnit.For(joint);
  return fmt::format(
      "the slowest constant speed is {:.3g} {}; hold several slower ones in both directions as "
      "well, down to about {:.2g} {}, or use a law without these parameters",
      slowest, unit, aim, unit);
}

std::string ExplainNoFall(std::string_view rest, std::string_view remedy) {
  return fmt::format("{} and stribeck_velocity cannot be distinguished from coulomb; {}", rest,
                     remedy);
}

std::string ExplainUnseenFall(std::string_view rest, double lowers, double needed,
                              std::string_view remedy) {
  return fmt::format(
      "no Stribeck effect can be seen: {} and stribeck_velocity explain {:.3g} times the noise "
      "variance, below {:.3g}; {}",
      rest, lowers, needed, remedy);
}

std::string ExplainSmallFall(std::string_view fall, double errors, double needed,
                             std::string_view remedy) {
  return fmt::format(
      "no Stribeck effect can be seen: {} is {:.3g} standard errors, below {:.3g}; {}", fall,
      errors, needed, remedy);
}

std::string ExplainVagueFall(const VagueFall& known, std::string_view remedy) {
  return fmt::format(
      "{} and stribeck_velocity cannot be distinguished: stribeck_velocity is known to a factor of "
      "{:.3g} only, {} to {:.3g}; {}",
      known.rest, known.velocity_factor, known.fall, known.half_width, remedy);
}

std::string ExplainUnknownStiffness() { return ExplainStiffness("do not determine the stiffness"); }

std::string ExplainVagueStiffness(double factor) {
  return ExplainStiffness(fmt::format("know the stiffness to a factor of {:.3g} only", factor));
}

std::string ExplainUnknownDamping(const UnknownDamping& damping, JointKind joint) {
  return fmt::format(
      "bristle_damping cannot be estimated: it is {:.3g} with a standard error of {:.3g} {}; "
      "reverse faster within the {:.2g} {} that the bristle bends, sampled in steps well below "
      "bristle_damping / bristle_stiffness, or give --set damping=none where it can be neglected",
      damping.value, damping.deviation, kViscousUnit.For(joint), damping.bend,
      kPositionUnit.For(joint));
}

std::string ExplainTurns(double at_turns, double at_constant_speeds, const std::string& unit) {
  return fmt::format(
      "around reversals the residual is {:.3g} {} rms, at constant speeds {:.3g}: the law misses "
      "what happens there; accelerate more slowly, log faster, or try --identifier stribeck",
      at_turns, unit, at_constant_speeds);
}

std::string SummaryOfFall(const FittedSamples& samples, double exponent) {
  return fmt::format("least squares on {}, exponent {:.3g} given", NameOfSamples(samples),
                     exponent);
}

std::string SummaryOfBristle(const FittedSamples& samples,
                             const std::optional<AroundReversals>& turns, const std::string& unit) {
  std::string summary = fmt::format("least squares on {}", NameOfSamples(samples));
  if (!turns) return summary;
  return summary + fmt::format(
                       ", {} of them around reversals, where the residual is {:.3g} {} rms; "
                       "elsewhere it is {:.3g}",
                       turns->samples, turns->residual, unit, turns->elsewhere);
}

}  // namespace warmjoint

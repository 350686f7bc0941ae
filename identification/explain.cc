#include "identification/explain.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

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

bool Warms(const Fit& fit) { return fit.RowOf(Role::heat).has_value(); }

/// The identifier of the linear laws that knows as much of warming as a fit does.
std::string_view LinearLike(const Fit& fit) { return Warms(fit) ? "energy-ml" : "nominal-ls"; }

/// What to try against friction that falls with speed: what the fit has of curve and warming is not
/// named again.
std::string RemedyForFallingSlope(const Fit& fit) {
  const std::string& law = fit.friction.law;
  // whether the law has a Stribeck curve already
  const bool curved = fit.friction.parameters.contains(std::string(kStribeckVelocityRow.name));
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
std::string RemedyForBound(const FitParameter& parameter, const Fit& fit) {
  if (parameter.part == LawPart::slope) return RemedyForFallingSlope(fit);
  // neither slope nor level: a linear law may do without it
  if (parameter.part != LawPart::level) {
    return fmt::format("try --identifier {}",
                       LinearCommand(LinearLike(fit), fit.friction.law).Text());
  }
  // gravity is fitted already, which leaves the sign as a cause
  const std::string torque =
      fit.gravity ? "is the sign of the torque"
                  : fmt::format(
                        "does the torque hold gravity or another load (try --identifier {} "
                        "--gravity paired), or is its sign",
                        LinearLike(fit));
  return fmt::format("a negative level would push the joint: {} reversed (--scale torque=-1)?",
                     torque);
}

/// "the torque comes 20 ms (2 samples) late against the positions"
std::string DescribeDelay(double delay, double step, std::string_view comes = "comes") {
  return fmt::format("the torque {} {:.3g} ms ({:.2g} samples) {} against the positions", comes,
                     1e3 * std::abs(delay), std::abs(delay) / step, delay < 0 ? "early" : "late");
}

/// What may act beside the friction that a fit holds: a question.
std::string_view BesideFriction(const Fit& fit) {
  return fit.gravity ? "do other joints move, or is a sign or a unit wrong?"
                     : "is there gravity (--gravity sincos), or a wrong sign or unit?";
}

/// An assumption as estimate.json has it. meaning: with a place for its size and the torque's unit
struct AssumptionWords {
  Source source;
  const char* meaning;
};

constexpr AssumptionWords kAssumptions[] = {
    {Source::cold_start,
     "the joint was cold at the start, not at a tenth of the warmth that it reaches"},
    {Source::open_start,
     "the joint was cold at the start, though for all that this log tells E(0) may be {:.2g} {}"},
    {Source::slow_drift, "nothing outside of the model changed the friction by 1 % over the log"},
    {Source::open_drift,
     "nothing outside of the model changed the friction slowly, though this log cannot rule it "
     "out"},
    {Source::open_curve,
     "friction depends on the speed as the law has it, though this log cannot rule out that it "
     "bends"},
    {Source::open_memory,
     "friction follows the speed at once, though this log cannot rule out that a part of it is "
     "late"},
    {Source::dead_band,
     "the torque's sensor has no dead band, though one of {:.2g} {} would stay unseen"},
    {Source::offset,
     "the torque has no offset and holds no load, though the one direction of the log would not "
     "show {:.2g} {}"},
    {Source::degrees, "positions and speeds are in radians, not both in degrees or revolutions"},
    {Source::clock, "the clock of the log is right, not off by 1 %"},
};

}  // namespace

std::string ExplainHeld(const std::vector<Excess>& held) {
  std::vector<std::string> words;
  for (const Excess& one : held) {
    words.push_back(
        fmt::format("{}: noise may do that, so it is set to {}", Describe(one), one.bound));
  }
  return fmt::format("{}", fmt::join(words, "; and "));
}

std::string ExplainHeldBesideMaps(const FitParameter& parameter) {
  return fmt::format("noise puts {} beyond its bound {}, so it is set to that", parameter.name,
                     parameter.lower);
}

std::string ExplainExcess(const Excess& excess, const Fit& fit) {
  return fmt::format("{}: law {} does not describe these data; {}", Describe(excess),
                     fit.friction.law, RemedyForBound(excess.parameter, fit));
}

std::string ExplainRiseFromRest(const Fit& fit) {
  const std::string& law = fit.friction.law;
  return fmt::format(
      "{}: friction rises from rest with speed, where law {} lets it fall; try --identifier {} "
      "--set law={}",
      fit.friction.parameters.contains(std::string(kStaticRiseRow.name))
          ? "static_rise is below 0"
          : "static is below coulomb",
      law, LinearLike(fit), HasLevelForEachDirection(law) ? "asymmetric" : "viscous_coulomb");
}

std::string ExplainDriving(double time, std::string_view remedy) {
  return fmt::format("at {:.6g} s the fitted friction drives the joint instead of braking it; {}",
                     time, remedy);
}

std::string RemedyForNonDissipative(std::string_view law, FittedGravity gravity) {
  const bool none = gravity == FittedGravity::none;
  // levels of their own for both directions
  const IdentifyCommand levels = IdentifyCommand{"energy-ml"}.With("law", Asymmetric::name);
  if (law != Asymmetric::name) {
    return Remedy{"", none ? levels : levels.With("gravity", NameOf(gravity))}.Text();
  }
  if (none) {
    return Remedy{"does the torque hold gravity or another load? ",
                  levels.With("gravity", NameOf(FittedGravity::paired))}
        .Text();
  }

  // both are fitted already: what is left is the sign
  return "is the sign of the torque reversed (--scale torque=-1)?";
}

std::string ExplainStructure(std::string_view name, double deviations, Action action) {
  const bool drops = action == Action::drop_intervals;
  return fmt::format(
      "{}: treating its slow part as noise would change {} by {:.2g} standard errors{}",
      drops ? "no intervals are given, since the residual holds structure and not only noise"
            : "the residual is not only noise",
      name, deviations, drops ? "" : "; intervals were widened to cover this");
}

std::string ExplainTurns(double at_turns, double at_constant_speeds, const std::string& unit) {
  return fmt::format(
      "around reversals the residual is {:.3g} {} rms, at constant speeds {:.3g}: the law misses "
      "what happens there; accelerate more slowly, log faster, or try --identifier stribeck",
      at_turns, unit, at_constant_speeds);
}

std::string ExplainStopped(std::size_t iterations, double rate, double remaining,
                           double tolerance) {
  return fmt::format(
      "stopped after {} iterations while the parameters still move: at the observed rate of {:.4f} "
      "an iteration they end up to {:.2g} % from here (tolerance {:.2g} %); give more iterations, "
      "or try --identifier energy-ml",
      iterations, rate, 100 * remaining, 100 * tolerance);
}

std::string ExplainDelay(double delay, double step) {
  return DescribeDelay(delay, step) + ", which the fit takes into account";
}

std::string ExplainUntoldDelay(double delay, double step) {
  return DescribeDelay(delay, step, "may come") +
         ", which this log does not tell: the intervals reach as far as that moves the values; log "
         "faster, or swing a known weight";
}

std::string ExplainDelayLeftOut(double delay, double step, double harm,
                                std::string_view identifier) {
  return fmt::format(
      "{}, which changes the friction by {:.2g} % and which {} does not take into account: try "
      "--identifier nominal-ls, or shift the torque in the file",
      DescribeDelay(delay, step), 100 * harm, identifier);
}

std::string ExplainLeftOutByLag(double lag) {
  return fmt::format(
      "the torque lags by {:.3g} s: samples within five times that after a change of speed are "
      "left out",
      lag);
}

std::string ExplainSettling(double settling) {
  return fmt::format(
      "the torque takes {:.2g} s to settle after a change of speed: the samples until then are "
      "left out",
      settling);
}

std::string ExplainImitated(const std::vector<std::string>& names) {
  return fmt::format(
      "the data cannot separate {} from the map; use total friction (at the speeds given, and "
      "bands), not {}",
      fmt::join(names, ", "), names.size() == 1 ? "this number" : "these numbers");
}

std::string ExplainDrivingFriction(const FrictionAtSpeed& at, const LogSamples& measurements,
                                   const Fit& fit) {
  return fmt::format(
      "the friction drives the joint: at {:.3g} {} it is {:.3g} {}; {} its sign reversed (--scale "
      "torque=-1)?",
      at.speed, kVelocityUnit.For(measurements.joint), at.value, measurements.torque_unit,
      fit.gravity ? "is" : "does the torque hold gravity (--gravity sincos), or is");
}

std::string ExplainHoles(const std::vector<std::string>& holes) {
  return fmt::format(
      "the map has no data at {}: it follows its neighbours there, and its bands are wide",
      fmt::join(holes, ", "));
}

std::string ExplainMotorRipple(bool forwards, const std::vector<std::pair<int, double>>& harmonics,
                               const std::string& unit) {
  std::string found;
  for (const auto& [multiple, amplitude] : harmonics) {
    found += fmt::format("{}{:.3g} {} at {} a turn", found.empty() ? "" : ", ", amplitude, unit,
                         multiple);
  }
  return fmt::format("motor ripple for v {} 0: {}", forwards ? ">" : "<",
                     found.empty() ? "none above the noise" : found);
}

std::string ExplainFindings(const std::vector<FoundPart>& found, const std::string& unit,
                            std::string_view effect, std::string_view remedy) {
  std::vector<std::string> words;
  for (const FoundPart& part : found) {
    words.push_back(fmt::format(
        "{}: {:.3g} {} rms, {:.2g} % of the friction, {:.{}f} % of the residual's variance",
        part.quantity, part.rms, unit, part.of_friction, part.of_residual,
        part.of_residual < 0.95 ? 1 : 0));
  }
  return fmt::format("the residual depends on {}{}; {}", fmt::join(words, "; and on "), effect,
                     remedy);
}

std::string ExplainTooMuch(std::string_view quantity, double harm, double relevance) {
  return fmt::format("; modelling {} would change the friction by {:.2g} % (--relevance {:.3g})",
                     quantity, 100 * harm, relevance);
}

std::string ExplainTooMuchTogether(double share, double most) {
  return fmt::format("; all of that is {:.2g} % of the friction, more than {:.2g} %", 100 * share,
                     100 * most);
}

std::string ExplainWidened(double largest) {
  return fmt::format(
      ": it changes the friction by {:.2g} % at most; intervals were widened to cover this",
      100 * largest);
}

std::string ExplainUnadjusted(const std::vector<std::string>& quantities,
                              const MovedParameter& moved, std::string_view remedy) {
  return fmt::format(
      "the residual may depend on {}: one test alone would call that found, among many it may be "
      "chance; intervals were widened to cover it, that of {} by {:.2g} {}{}",
      fmt::join(quantities, ", or on "), moved.parameter.name, moved.change, moved.parameter.unit,
      remedy);
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
  return fmt::format(
      "the fit rests on {} of {} samples that move, and takes {} and {:.0f} % of them: record "
      "longer, or use the others (--motion {})",
      used, moving, fewest, 100 * least_share, motion == MotionKind::any ? "constant" : "any");
}

std::string ExplainWorseThanMean(double fit_share, const Fit& fit) {
  return fmt::format(
      "the torque's mean follows it better than the friction does (Fit {:.3g} %): {}", fit_share,
      BesideFriction(fit));
}

std::string ExplainPoorFit(double fit_share, double least, const Fit& fit) {
  return fmt::format(
      "the fit explains little of the torque (Fit {:.3g} %, of {:.0f} % at least): {}", fit_share,
      least, BesideFriction(fit));
}

std::string ExplainWorseHeldOut(double fit_share, const Fit& fit) {
  return fmt::format(
      "the last part of the log, which a fit to the first has not seen, is predicted worse than by "
      "its mean (Fit {:.3g} %): the joint changed, or it is not friction; {}",
      fit_share, BesideFriction(fit));
}

std::string ExplainMuchLeft(double left, double friction, const Fit& fit) {
  return fmt::format(
      "the fit leaves {:.3g} of the torque (rms), more than half of the friction that it finds, "
      "{:.3g}: {}",
      left, friction, BesideFriction(fit));
}

std::string ExplainNoFriction(double share) {
  return fmt::format(
      "this torque holds no friction: what was fitted is {:.2g} % of it. A sensor behind the gear "
      "and the torque of a model show none; log that of the motor, or its current",
      100 * share);
}

std::string ExplainNegativeInertia(const FitParameter& inertia,
                                   const std::array<double, 2>& interval95) {
  return fmt::format(
      "inertia is {:.3g} {}, below 0 with its whole 95 % interval, {:.3g} to {:.3g}: the torque "
      "is late or early against the motion, has the wrong sign (--scale torque=-1), or another "
      "load acts",
      inertia.value, inertia.unit, interval95[0], interval95[1]);
}

std::string NameOfFriction(const FrictionAtSpeed& at) {
  std::string name = fmt::format("friction {} at {:.3g}", at.speed < 0 ? "backwards" : "forwards",
                                 std::abs(at.speed));
  if (!at.speed_unit.empty()) name += " " + at.speed_unit;
  if (at.energy) name += *at.energy == 0 ? ", cold" : ", warm";
  return name;
}

std::string ExplainUnknownFriction(const std::vector<FrictionAtSpeed>& all) {
  const FrictionAtSpeed& one = all[all.size() / 2];
  return fmt::format(
      "the friction is known to worse than itself at every speed of the log ({} is {:.2g} {}, its "
      "95 % interval {:.2g} to {:.2g}): record longer, at steadier speeds in both directions",
      NameOfFriction(one), one.value, one.unit, one.interval95[0], one.interval95[1]);
}

std::string ExplainLeftOutSpeeds(const std::vector<FrictionAtSpeed>& left_out) {
  std::vector<std::string> names;
  for (const FrictionAtSpeed& one : left_out) names.push_back(NameOfFriction(one));
  return fmt::format("left out, since it is known to worse than itself: {}",
                     fmt::join(names, "; "));
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

std::string ExplainOwnLaw(const MovedParameter& moved) {
  return fmt::format(
      "the estimate does not fit its log: the same law fits it better with {} changed by {:.3g} "
      "{}; fit again, and check units, signs and the samples that were used",
      moved.parameter.name, moved.change, moved.parameter.unit);
}

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

std::vector<Assumption> AssumptionsOf(const std::vector<Cause>& causes, const Fit& fit,
                                      const std::string& unit) {
  std::vector<Assumption> assumptions;
  for (const AssumptionWords& words : kAssumptions) {
    // rows of one source are ways in which it may be wrong: of each parameter the worst
    const Cause* first = nullptr;
    Eigen::VectorXd moves;
    for (const Cause& cause : causes) {
      if (cause.source != words.source || cause.bias.size() == 0) continue;
      if (!first) {
        first = &cause;
        moves = cause.bias;
      }
      moves = (cause.bias.cwiseAbs().array() > moves.cwiseAbs().array()).select(cause.bias, moves);
    }
    if (!first) continue;
    assumptions.push_back({std::string(NameOf(words.source)),
                           fmt::format(fmt::runtime(words.meaning), first->size, unit),
                           NamedMoves(first->rows, moves, fit)});
  }
  return assumptions;
}

ParameterMoves NamedMoves(const std::vector<size_t>& rows, const Eigen::VectorXd& moves,
                          const Fit& fit) {
  ParameterMoves named;
  if (moves.size() == 0) return named;
  for (size_t i = 0; i < rows.size(); ++i) {
    named.emplace_back(fit.parameters[rows[i]].name, moves[static_cast<Eigen::Index>(i)]);
  }
  return named;
}

}  // namespace warmjoint

// Identifier `auto`: chooses the structure, then identifies it.
//
// Tries the laws, cold and warm, with the Stribeck effect (with a level for each direction where the
// residual has a mean force in one direction). What these lack fields take up in the fit of the chosen one; without fields
// there are also maps over position, and over the motor's angle where a gear is given. Drops those that the recording cannot identify, and
// those to which BIC prefers a simpler one; compares the others by the error on contiguous blocks
// that were left out of the fit (hold_out.h) and takes the simplest that is not worse than the
// best beyond what that gains by chance (model_comparison.h). The fit is that structure's on all the data; the
// message says why and lists all candidates.
//
// not_identifiable where the motion cannot distinguish viscous from coulomb: then no law can be chosen.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>

#include "identification/fit/fit_data.h"
#include "identification/fit/seen_samples.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/identifiers/model_comparison.h"
#include "identification/identifiers/structures.h"
#include "identification/inference/bounds.h"
#include "identification/lagged/lagged_fit.h"
#include "identification/linear/rigid_part.h"
#include "identification/preparation/check.h"
#include "identification/preparation/delayed_motion.h"
#include "identification/sentences/choice.h"
#include "identification/sentences/late_torque.h"
#include "identification/warming/initial_energy.h"
#include "identification/warming/torque_delay.h"

namespace warmjoint {
namespace {

constexpr const char* kName = "auto";

/// Why a log is too short for any warming; empty where it is not.
std::string WhyTooShort(const IdentifierInput& input) {
  const Eigen::VectorXd& time = input.measurements.time;
  const double duration = time[time.size() - 1] - time[0];
  if (duration >= kShortestWarming) return "";
  return ExplainShortLog(duration);
}

/// Tries structures; those with warming only where the log is long enough.
void TryWarm(const std::vector<Structure>& structures, const IdentifierInput& input,
             ModelComparison& comparison) {
  const std::string why = WhyTooShort(input);
  if (why.empty()) {
    comparison.Add(structures);
  } else {
    comparison.LeaveOut(structures, why);
  }
}

/// Laws with and without warming, then with free gravity in addition to the best of them.
void TryLinear(const IdentifierInput& input, ModelComparison& comparison) {
  const std::vector<FittedGravity> kinds = GravityKinds(input);
  for (const FittedGravity gravity : kinds) {
    if (gravity == FittedGravity::paired && kinds.size() > 1) continue;
    comparison.Add(ColdStructures(gravity));
    // a warming with a further gravity only where the data may determine it
    if (gravity == kinds.front() || comparison.MayWarmWith(gravity)) {
      TryWarm(WarmStructures(gravity), input, comparison);
    } else {
      comparison.LeaveOut(WarmStructures(gravity), kNoGravityNorWarming);
    }
  }

  // gravity that is free over place, only in addition to the best of them, and where no field is
  const bool asked = input.options.Get<AutoOptions>().gravity.kind.has_value();
  if (!asked && !input.options.Get<AutoOptions>().fields.kinds.empty()) return;
  if (kinds.size() > 1 && kinds.back() == FittedGravity::paired) {
    if (const Structure* best = comparison.Best()) {
      comparison.Add({best->With(GravityOption{FittedGravity::paired})});
    }
  }
}

/// The best structure so far with friction that grows with what the joint carries, where gravity acts or the log has the load.
void TryLoad(const IdentifierInput& input, ModelComparison& comparison) {
  const Structure* best = comparison.Best();
  if (!best || (best->gravity() == FittedGravity::none && !input.measurements.load)) return;
  comparison.Add({best->With(LoadOption{PartFit::estimated})});
}

/// Gravity to try with maps: that of the best linear structure, but a sine where that is paired, over
/// a joint that turns, where the map follows all that is not a sine.
FittedGravity GravityForMaps(const IdentifierInput& input, const Structure* best) {
  const std::vector<FittedGravity> kinds = GravityKinds(input);
  const FittedGravity gravity = best ? best->gravity() : kinds.front();
  const bool turns = std::ranges::find(kinds, FittedGravity::sincos) != kinds.end();
  return gravity == FittedGravity::paired && turns ? FittedGravity::sincos : gravity;
}

/// Tries laws with a curve over the speed and maps, with the gravity of the best linear structure.
void TryCurved(const IdentifierInput& input, ModelComparison& comparison) {
  const FittedGravity gravity = GravityForMaps(input, comparison.Best());
  const bool cold = TakesColdStart(input.options), too_short = !WhyTooShort(input).empty();

  // a curve over the speed, with and without warming
  comparison.Add({StribeckStructure(PartFit::none, gravity)});
  if (too_short) {
    comparison.LeaveOut({StribeckStructure(PartFit::estimated, gravity)}, WhyTooShort(input));
  } else if (!cold) {
    comparison.LeaveOut({StribeckStructure(PartFit::estimated, gravity)}, kTakesColdStartAlone);
  } else if (comparison.MayBendAndWarm(gravity)) {
    comparison.Add({StribeckStructure(PartFit::estimated, gravity)});
  } else {
    comparison.LeaveOut({StribeckStructure(PartFit::estimated, gravity)}, kNoBendNorWarming);
  }

  // a level for each direction, where one may help
  for (const PartFit warming : {PartFit::none, PartFit::estimated}) {
    if ((!cold || too_short) && warming != PartFit::none) continue;
    if (!comparison.MayHaveTwoLevels(warming, gravity)) continue;
    comparison.Add({TwoLevelStribeckStructure(warming, gravity)});
  }

  // maps, where something is left over place that no field takes up
  const FieldSet& fields = input.options.Get<AutoOptions>().fields;
  if (!fields.kinds.empty()) return;
  if (comparison.MayHaveMap()) {
    for (const Structure& map :
         MapStructures(input, gravity, comparison.KernelsGivenBest(gravity))) {
      if (map.CanWarm()) {
        TryWarm({map}, input, comparison);
      } else {
        comparison.Add({map});
      }
    }
  } else {
    comparison.LeaveOut(MapStructures(input, gravity), kNothingOverPlace);
  }
}

/// How late the torque is, s: by a first-order lag at constant speeds, by a delay for motion of any kind.
struct Lateness {
  std::optional<double> lag, delay;
};

/// All trials. If the best linear structure finds a lag, they use only samples at which the torque has settled after it; if it
/// finds a delay, the motion of that delay earlier.
struct Trials {
  std::unique_ptr<const LogView> behind;  // of a delay
  std::unique_ptr<ModelComparison> comparison;
  Lateness late;
};

Trials TryAll(const IdentifierInput& input) {
  Trials trials;
  const auto begin = [&](const IdentifierInput& seen, const Selection& selection) {
    trials.comparison = std::make_unique<ModelComparison>(seen, selection);
    TryLinear(seen, *trials.comparison);
  };
  begin(input, input.selection);
  trials.late = {trials.comparison->LagOfBest(input), trials.comparison->DelayOfBest(input)};

  // a torque that is late: all again. Else a load or a map would take up a part of what a delay does
  const auto& [lag, delay] = trials.late;
  const LogView all{input.measurements, input.selection};
  if (lag) begin(input, Settled(input.measurements, input.selection, *lag));
  if (delay) trials.behind = std::make_unique<const LogView>(Delayed(all, *delay));
  const IdentifierInput seen = delay ? input.On(*trials.behind) : input;
  if (delay) begin(seen, seen.selection);
  TryLoad(seen, *trials.comparison);
  TryCurved(seen, *trials.comparison);
  return trials;
}

/// The chosen structure on every sample: with lag and delay where it can estimate them, else on samples
/// where the torque has settled, or with the motion of a delay earlier.
Fit FitOnAll(const Structure& chosen, const Lateness& late, const IdentifierInput& input) {
  const std::optional<double>& lag = late.lag;
  // one that cannot estimate a delay takes it as it was found
  if (late.delay && !chosen.CanEstimateDelay()) {
    const LogView view = Delayed({input.measurements, input.selection}, *late.delay);
    Fit fit = chosen.Fitted(input.On(view));
    TakeDelay(*late.delay, input.measurements, fit);
    return fit;
  }
  if (!lag || chosen.CanEstimateLag()) return chosen.Fitted(input);
  const Selection settled = Settled(input.measurements, input.selection, *lag);
  Fit fit = chosen.Fitted(input.With(settled));
  fit.causes.push_back(Note(ExplainLeftOutByLag(*lag)));
  return fit;
}

/// A structure with fields where it can have them, or with a lag where trials found one and the lag leaves less than the fields do: a
/// ripple over the position looks like a lag, and the other way round.
Structure WithLagOrFields(const Structure& chosen, const Lateness& late,
                          const IdentifierInput& input) {
  const FieldSet& fields = input.options.Get<AutoOptions>().fields;
  const bool may_lag = late.lag && chosen.CanEstimateLag();
  const bool may_have = chosen.CanHaveFields() && !fields.kinds.empty();
  const Structure lagged = may_lag ? chosen.With(LagOption{PartFit::estimated}) : chosen;
  if (!may_have) return lagged;
  Structure with = chosen.With(FieldOption{fields});
  if (!may_lag) return with;
  const auto squares = [&](const Structure& one) {
    const Fit fit = FitOnAll(one.PointEstimate(), late, input);
    return fit.refusal ? kInfinity : fit.rows.residual().squaredNorm();
  };
  return squares(lagged) < squares(with) ? lagged : with;
}

// of -2 log p: odds of twenty to one; why: a friction file holds a warming, and no measured temperature
constexpr double kOdds = 5.99;

/// The same law without warming, whose friction follows the temperature that the log has, where that is likelier than the warming.
std::optional<Structure> FollowingTemperature(const Structure& chosen, const Fit& fit,
                                              const Lateness& late, const IdentifierInput& input) {
  const FieldSet& fields = input.options.Get<AutoOptions>().fields;
  const bool may_follow =
      input.measurements.temperature && fields.Has(FieldKind::temperature_friction);
  if (!may_follow || !chosen.CanWarm() || !fit.figures.fields) return std::nullopt;
  const Structure cold = Structure{FindIdentifier("nominal-ls"), "law"}
                             .With(chosen.identifier.options.Get<LawOption>())
                             .With(GravityOption{chosen.gravity()});
  // without a drift, which no likelihood tells from a warming
  FieldOption rivals{fields};
  std::erase(rivals.fields.kinds, FieldKind::time_friction);
  const Fit rival = FitOnAll(cold.With(rivals), late, input);
  if (!rival.figures.fields || !(rival.figures.fields->cost + kOdds < fit.figures.fields->cost))
    return std::nullopt;
  return cold.With(FieldOption{fields});
}

/// Why this structure was chosen.
std::string Reason(const std::vector<StructureCandidate>& contenders, const Choice& choice,
                   int blocks, const std::string& unit) {
  const auto compared = [&](std::size_t i) {
    return ComparedStructure{contenders[i].name, std::sqrt(contenders[i].MeanSquare())};
  };
  const ComparedStructure chosen = compared(choice.chosen);
  if (choice.chosen == choice.best) return ExplainSmallestError(chosen, unit, blocks);
  return ExplainSimplest(chosen, compared(choice.best), unit, blocks);
}

/// What the fit lacks because the motion does not show it, as `check` finds it, each a clause and a semicolon: the slope over
/// speed where one speed was held, and warming in a short log.
std::string NotShown(const Fit& fit, const PreparedLog& log) {
  const auto is_slope = [](const Unknown& one) { return one.part == LawPart::slope; };
  const bool slopes = std::ranges::any_of(fit.parameters, is_slope);
  const bool warms = fit.RowOf(Role::gain).has_value();
  std::string clauses;
  for (const Excitation& one : CheckRecording(log).excitation) {
    if (one.sufficient) continue;
    if (one.kind == FrictionKind::viscous_coulomb && !slopes) {
      clauses += ExplainUnseenSlope(one.reason);
    }
    if (one.kind == FrictionKind::warm_up && !warms) clauses += ExplainUnseenWarmUp(one.reason);
  }
  return clauses;
}

/// Nothing that was tried fits.
Fit NothingFits(const ModelComparison& comparison, StructureChoice choice) {
  const Inference& first = comparison.First().inferred;
  const Status status = first.status == Status::ok ? Status::not_identifiable : first.status;
  Fit fit = Refused(
      kName, status,
      ExplainNothingFits(choice.trials.size(), comparison.First().structure.Name(), first.message));
  fit.choice = std::move(choice);
  return fit;
}

/// A structure that was chosen, and why.
struct Chosen {
  Structure structure;
  StructureChoice reported;
};

/// The choice among the structures that are not dropped; nothing where none gives friction.
std::optional<Chosen> Choose(const IdentifierInput& input, ModelComparison& comparison) {
  const int blocks = input.options.Get<AutoOptions>().blocks;
  // structures that cannot be chosen are dropped first; the others are compared on held-out blocks
  comparison.DropDominated();
  const Structure* only = comparison.OnlyOne();
  std::vector<StructureCandidate> contenders;
  if (!only) contenders = comparison.Compare(blocks);
  const Structure* best = comparison.Best();
  if (!best) return std::nullopt;

  // chosen by the blocks, or by BIC where every structure needs one of the blocks, as one with the whole warm-up
  Chosen chosen{only ? *only : *best, {"", "", blocks, comparison.Reported()}};
  std::string& reason = chosen.reported.reason;
  if (only) {
    reason = ExplainOnlyOne(only->Name());
  } else if (contenders.empty()) {
    reason = ExplainChosenByBic(best->Name(), blocks);
  } else {
    const Choice choice = ChooseStructure(contenders);
    chosen.structure = comparison.Contending(choice.chosen);
    reason = Reason(contenders, choice, blocks, input.measurements.torque_unit);
  }
  return chosen;
}

/// The chosen structure fitted to every sample, with the reason before the summary of the fit.
Fit FitToAll(Chosen chosen, const Lateness& late, const IdentifierInput& input) {
  input.Tell("fitting " + chosen.structure.Name() + " to every sample");
  Structure structure = WithLagOrFields(chosen.structure, late, input);
  const MakeFit make = [&](const IdentifierInput& other) {
    return FitOnAll(structure, late, other);
  };
  Fit fit = WithoutNegativeInertia(make, input);
  if (const auto rival = FollowingTemperature(structure, fit, late, input)) {
    structure = *rival;
    chosen.reported.reason = kFollowsTemperature;
    fit = WithoutNegativeInertia(make, input);
  }

  // what is reported, and the same structure for other samples
  chosen.reported.chosen =
      structure.CanHaveFields() ? structure.With(FieldOption{}).Name() : structure.Name();
  const auto inertia = fit.RowOf(Role::inertia);
  if (inertia && !fit.parameters[*inertia].estimated) {
    structure.identifier.options = WithoutInertia(structure.identifier.options);
  }
  fit.identifier = kName;
  fit.summary = SummaryOfChoice(NotShown(fit, input.log), chosen.reported.reason, fit.summary);
  fit.choice = std::move(chosen.reported);
  fit.structure = [sketch = structure.PointEstimate(), late](const IdentifierInput& other) {
    return FitOnAll(sketch, late, other);
  };
  return fit;
}

Fit FitChosen(const IdentifierInput& input) {
  const int blocks = input.options.Get<AutoOptions>().blocks;
  if (auto why = Unusable(input, 2 * blocks)) return Refused(kName, Status::bad_data, *why);

  // compare on rows that hold the means of neighbours; structures without a slope are dropped before all
  const Trials trials = TryAll(input);
  ModelComparison& comparison = *trials.comparison;
  comparison.DropWithoutSlope();

  // one that leaves its bounds on every sample is no contender
  std::optional<Fit> first;
  while (const auto chosen = Choose(input, comparison)) {
    Fit fit = FitToAll(*chosen, trials.late, input);
    if (fit.refusal || GivesFriction(fit)) return first && fit.refusal ? *std::move(first) : fit;
    comparison.DropBeyondBounds(chosen->structure);
    if (!first) first = std::move(fit);
  }
  if (first) return *std::move(first);
  return NothingFits(comparison, {"", "", blocks, comparison.Reported()});
}

}  // namespace

Identifier Auto() {
  return {kName,
          "chooses law, gravity, warming and maps by hold-out, the simplest that is not worse, and "
          "says why",
          OptionGroups<AutoOptions, MotionOption, InitialEnergyOptions>{}, &FitChosen};
}

}  // namespace warmjoint

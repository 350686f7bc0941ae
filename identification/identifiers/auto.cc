#include "identification/identifiers/auto.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "identification/fit_data.h"
#include "identification/holdout/blocked_hold_out.h"
#include "identification/holdout/structure_choice.h"
#include "identification/identifiers/lag_of_log.h"
#include "identification/identifiers/structures.h"
#include "identification/inference/inference.h"
#include "identification/linear/rigid_part.h"
#include "identification/preparation/condense.h"

namespace warmjoint::inline identification {
namespace {

constexpr const char* kName = "auto";
constexpr Eigen::Index kRows = 3000;    // on which structures are compared
constexpr double kHopeless = 4;         // of the mean squared error of another
constexpr double kFewParameters = 0.1;  // of the rows

/// What became of a structure on the rows that are compared.
struct Trial {
  Structure structure;
  Fit fit;
  Inference told;
  std::string dropped;                    // why it is no contender; empty for one that is
  std::optional<Eigen::VectorXd> errors;  // on blocks, of a contender

  double Parameters() const { return fit.effective_parameters; }
  double MeanSquare() const {
    return fit.residual().squaredNorm() / static_cast<double>(fit.torque.size());
  }
};

Trial Try(const Structure& structure, const IdentifierInput& input) {
  Trial trial{structure, structure.Fitted(input), {}, {}, {}};
  trial.told = Infer(trial.fit);
  if (trial.told.status != Status::ok) {
    trial.dropped = StatusName(trial.told.status);
  } else if (!trial.told.gives_friction) {
    trial.dropped = "gives no friction";
  }
  return trial;
}

/// Everything that is tried on one log.
class Tournament {
 public:
  /// On rows that hold the means of neighbouring samples. selection: of the samples that take part.
  Tournament(const IdentifierInput& input, const Selection& selection)
      : view_(Condense({input.measurements, selection}, kRows)),
        quick_(input.On(view_)),
        rows_(static_cast<double>(quick_.selection.count())) {}
  Tournament(const Tournament&) = delete;
  Tournament& operator=(const Tournament&) = delete;

  void Add(const std::vector<Structure>& structures) {
    for (const Structure& structure : structures) {
      quick_.Tell("trying " + structure.Name());
      trials_.push_back(Try(structure, quick_));
    }
  }

  /// The structure that BIC prefers so far, of those that fit all rows; none where nothing does.
  const Structure* Best() const {
    const Trial* best = nullptr;
    for (const Trial& trial : trials_) {
      const bool fits = trial.told.status == Status::ok && trial.told.gives_friction;
      if (fits && (!best || BicOf(trial) < BicOf(*best))) best = &trial;
    }
    return best ? &best->structure : nullptr;
  }

  /// Whether a level for each direction may help the Stribeck law with that warming: what it leaves
  /// pushes in one direction. Where it does not fit, the linear law tells; with warming, which costs more,
  /// that two levels fit without it.
  bool MayHaveTwoLevels(const std::string& warming) const {
    const Trial& one = *Find(StribeckStructure(warming));
    if (one.told.status == Status::ok) return Pushes(one.fit);
    if (warming == "none") return Pushes(First().fit);
    const Trial* cold = Find(TwoLevelStribeckStructure("none"));
    return cold && cold->told.status == Status::ok;
  }

  /// Drops those that cannot be chosen whatever the blocks say: BIC prefers a simpler one, or another
  /// leaves half of the residual.
  void DropHopeless() {
    std::vector<bool> standing;
    for (const Trial& trial : trials_) standing.push_back(trial.dropped.empty());
    for (size_t i = 0; i < trials_.size(); ++i) {
      for (size_t j = 0; j < trials_.size() && standing[i] && trials_[i].dropped.empty(); ++j) {
        if (j != i && standing[j]) trials_[i].dropped = WhyOutdone(trials_[i], trials_[j]);
      }
    }
  }

  /// Errors of those that stand, on blocks that they have not seen.
  std::vector<Contender> Compare(int blocks) {
    const std::vector<Eigen::Index> bounds = CutIntoBlocks(quick_.selection, blocks);
    std::vector<Contender> contenders;
    standing_.clear();
    for (Trial& trial : trials_) {
      if (!trial.dropped.empty()) continue;
      quick_.Tell(
          fmt::format("comparing on {} held-out blocks: {}", blocks, trial.structure.Name()));
      trial.errors = trial.structure.ErrorsOn(quick_, bounds);
      if (!trial.errors) trial.dropped = "fails without one of the blocks";
      if (!trial.errors || !trial.errors->allFinite()) continue;
      standing_.push_back(&trial);
      contenders.push_back(
          {trial.structure.Name(), *trial.errors, trial.MeanSquare(), trial.Parameters()});
    }
    return contenders;
  }

  const Structure& Contending(size_t i) const { return standing_[i]->structure; }
  const Trial& First() const { return trials_.front(); }
  double rows() const { return rows_; }

  std::vector<StructureTrial> Told() const {
    std::vector<StructureTrial> told;
    for (const Trial& trial : trials_) {
      StructureTrial& one = told.emplace_back();
      one.name = trial.structure.Name();
      one.parameters = trial.Parameters();
      one.dropped = trial.dropped;
      if (trial.errors) one.rmse = std::sqrt(trial.errors->mean());
    }
    return told;
  }

 private:
  double BicOf(const Trial& one) const { return Bic(one.MeanSquare(), one.Parameters(), rows_); }

  /// The trial of a structure; null where it was not tried.
  const Trial* Find(const Structure& structure) const {
    const auto found = std::ranges::find_if(
        trials_, [&](const Trial& trial) { return trial.structure.Name() == structure.Name(); });
    return found == trials_.end() ? nullptr : &*found;
  }

  /// Whether the residual has a mean, which BIC would give a parameter.
  bool Pushes(const Fit& fit) const {
    const Eigen::VectorXd residual = fit.residual();
    if (residual.size() == 0) return false;
    const double mean = residual.mean();
    const double square = residual.squaredNorm() / static_cast<double>(residual.size());
    return Bic(square - mean * mean, 1, rows_) < Bic(square, 0, rows_);
  }

  std::string WhyOutdone(const Trial& one, const Trial& other) const {
    if (other.Parameters() < one.Parameters() && BicOf(other) <= BicOf(one)) {
      return fmt::format("outdone by {}, which is simpler", other.structure.Name());
    }
    if (other.Parameters() < kFewParameters * rows_ &&
        kHopeless * other.MeanSquare() < one.MeanSquare()) {
      return fmt::format("{} leaves less than half of its residual", other.structure.Name());
    }
    return "";
  }

  const LogView view_;
  const IdentifierInput quick_;
  double rows_;
  std::vector<Trial> trials_;
  std::vector<const Trial*> standing_;
};

/// Laws with and without warming, then gravity beside the best of them.
void TryLinear(const IdentifierInput& input, Tournament& tournament) {
  const std::vector<std::string> kinds = GravityKinds(input);
  for (const std::string& gravity : kinds) {
    if (gravity != "paired" || kinds.size() == 1) tournament.Add(LinearStructures(gravity));
  }
  if (kinds.size() > 1 && kinds.back() == "paired") {
    if (const Structure* best = tournament.Best()) {
      tournament.Add({best->With("gravity", "paired")});
    }
  }
}

/// What bends or ripples, with the gravity of the best linear one.
void TryCurved(const IdentifierInput& input, Tournament& tournament) {
  const Structure* best = tournament.Best();
  const std::string gravity = best ? best->Given("gravity", "none") : GravityKinds(input).front();
  tournament.Add({StribeckStructure("none"), StribeckStructure("estimated")});
  for (const char* warming : {"none", "estimated"}) {
    if (tournament.MayHaveTwoLevels(warming)) tournament.Add({TwoLevelStribeckStructure(warming)});
  }
  tournament.Add(MapStructures(input, gravity));
}

/// Everything, on samples behind whose lag the torque has settled, if the best linear structure finds
/// one.
struct Trials {
  std::unique_ptr<Tournament> tournament;
  std::optional<double> lag;  // s
};

Trials TryAll(const IdentifierInput& input) {
  Trials trials;
  trials.tournament = std::make_unique<Tournament>(input, input.selection);
  TryLinear(input, *trials.tournament);
  if (const Structure* best = trials.tournament->Best()) {
    input.Tell("looking for a lag of the torque");
    trials.lag = LagOf(*best, input);
  }
  if (trials.lag) {
    trials.tournament = std::make_unique<Tournament>(
        input, Settled(input.measurements, input.selection, *trials.lag));
    TryLinear(input, *trials.tournament);
  }
  TryCurved(input, *trials.tournament);
  return trials;
}

/// The chosen structure on every sample: behind the lag where it can estimate one, else on samples
/// where the torque has settled.
Fit FitOnAll(const Structure& chosen, const std::optional<double>& lag,
             const IdentifierInput& input) {
  if (!lag || chosen.CanTellLag()) return chosen.Fitted(input);
  const Selection settled = Settled(input.measurements, input.selection, *lag);
  Fit fit = chosen.Fitted(input.With(settled));
  fit.warnings.push_back(
      fmt::format("the torque lags by {:.3g} s: samples within five times that after a change of "
                  "speed are left out",
                  *lag));
  return fit;
}

/// Why the chosen one.
std::string Reason(const std::vector<Contender>& contenders, const Choice& choice, int blocks,
                   const std::string& unit) {
  const Contender& chosen = contenders[choice.chosen];
  std::string reason = fmt::format("chose {}: RMSE {:.4g} {} on {} held-out blocks of time, ",
                                   chosen.name, std::sqrt(chosen.errors.mean()), unit, blocks);
  if (choice.chosen == choice.best) return reason + "the smallest of all";
  return reason + fmt::format("simpler than {} ({:.4g}) and not significantly worse",
                              contenders[choice.best].name,
                              std::sqrt(contenders[choice.best].errors.mean()));
}

/// Nothing that was tried fits.
Fit NothingFits(const Tournament& tournament, StructureChoice choice) {
  const Inference& first = tournament.First().told;
  const Status status = first.status == Status::ok ? Status::not_identifiable : first.status;
  Fit fit = Refused(kName, status,
                    fmt::format("none of {} structures fits; {} says: {}", choice.trials.size(),
                                tournament.First().structure.Name(), first.message));
  fit.choice = std::move(choice);
  return fit;
}

Fit FitChosen(const IdentifierInput& input) {
  const int blocks = input.options.Integer("blocks");
  if (auto why = Unusable(input, 2 * blocks)) return Refused(kName, Status::bad_data, *why);

  // compare on rows that hold the means of neighbours
  const Trials trials = TryAll(input);
  Tournament& tournament = *trials.tournament;
  tournament.DropHopeless();
  const std::vector<Contender> contenders = tournament.Compare(blocks);
  StructureChoice told{"", "", blocks, tournament.Told()};
  const Structure* best = tournament.Best();
  if (!best) return NothingFits(tournament, std::move(told));

  // by the blocks, or by BIC where none can do without one of them, as one that holds the warm-up
  Structure chosen = *best;
  if (contenders.empty()) {
    told.reason = fmt::format("chose {} by BIC: none can do without one of the {} blocks of time",
                              chosen.Name(), blocks);
  } else {
    const Choice choice = ChooseStructure(contenders, tournament.rows());
    chosen = tournament.Contending(choice.chosen);
    told.reason = Reason(contenders, choice, blocks, input.measurements.torque_unit);
  }

  // on every sample, with the reason before what it says
  if (trials.lag && chosen.CanTellLag()) {
    chosen = chosen.With("torque_lag", "estimated");
  }
  input.Tell("fitting " + chosen.Name() + " to every sample");
  Fit fit = FitOnAll(chosen, trials.lag, input);
  told.chosen = chosen.Name();
  fit.identifier = kName;
  fit.summary = fmt::format("{}; {}", told.reason, fit.summary);
  fit.choice = std::move(told);
  fit.structure = [chosen, lag = trials.lag](const IdentifierInput& other) {
    return FitOnAll(chosen, lag, other);
  };
  return fit;
}

}  // namespace

Identifier Auto() {
  OptionInfo gravity = GravityOption();
  gravity.default_value = "chosen";
  gravity.allowed = "chosen|" + gravity.allowed;
  return {kName,
          "chooses law, gravity, warming and maps by hold-out, the simplest that is not worse, and "
          "says why",
          {{"blocks", "6", "integer >= 3 <= 50", "contiguous parts of the recording to hold out"},
           gravity,
           MotionOption()},
          &FitChosen};
}

}  // namespace warmjoint::inline identification

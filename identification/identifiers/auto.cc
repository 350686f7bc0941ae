#include "identification/identifiers/auto.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "identification/fit_data.h"
#include "identification/holdout/blocked_hold_out.h"
#include "identification/holdout/structure_choice.h"
#include "identification/identifiers/energy_ml.h"
#include "identification/identifiers/motor_ridge.h"
#include "identification/identifiers/nominal_ls.h"
#include "identification/identifiers/position_ridge.h"
#include "identification/identifiers/stribeck.h"
#include "identification/inference/inference.h"
#include "models/recording/motor_angle.h"

namespace warmjoint::inline identification {
namespace {

constexpr const char* kName = "auto";

/// One structure to try.
struct Candidate {
  Identifier identifier;
  std::map<std::string, std::string> given;  // its options

  std::string Name() const {
    std::string name = identifier.name;
    for (const auto& [key, value] : given) name += fmt::format(" {}={}", key, value);
    return name;
  }
};

/// What became of it.
struct Trial {
  Candidate candidate;
  Fit fit;                                // on all the data
  Inference told;                         // by that fit
  std::string dropped;                    // why it is no contender; empty for one that is
  std::optional<Eigen::VectorXd> errors;  // on blocks, of a contender

  double Parameters() const { return fit.effective_parameters; }
  double MeanSquare() const {
    return fit.residual().squaredNorm() / static_cast<double>(fit.torque.size());
  }
};

/// All structures, the plain law (2) first.
std::vector<Candidate> Candidates(const Measurements& m) {
  std::vector<Candidate> candidates;
  for (const char* law : {"viscous_coulomb", "coulomb", "asymmetric"}) {
    candidates.push_back({NominalLs(), {{"law", law}}});
  }
  for (const char* law : {"coulomb", "viscous_coulomb", "asymmetric"}) {
    candidates.push_back({EnergyMl(), {{"law", law}}});
  }
  for (const char* warming : {"none", "estimated"}) {
    candidates.push_back({StribeckByCeres(), {{"warming", warming}}});
  }
  candidates.push_back({PositionRidge(), {}});
  candidates.push_back({EnergyMl(), {{"position", "map"}}});
  if (KnowsMotorAngle(m)) candidates.push_back({MotorRidge(), {}});
  return candidates;
}

/// The candidate on all the data.
Trial Try(const Candidate& candidate, const IdentifierInput& input) {
  const Options options(candidate.identifier.options, candidate.given, {});
  Trial trial{candidate, candidate.identifier.fit(input.With(options)), {}, {}, {}};
  trial.told = Infer(trial.fit);
  if (trial.told.status != Status::ok) {
    trial.dropped = StatusName(trial.told.status);
  } else if (!trial.told.gives_friction) {
    trial.dropped = "gives no friction";
  }
  return trial;
}

/// Its errors on blocks that it has not seen.
std::optional<Eigen::VectorXd> ErrorsOf(const Candidate& candidate, const IdentifierInput& input,
                                        const std::vector<Eigen::Index>& bounds) {
  const Options options(candidate.identifier.options, candidate.given, {});
  return BlockedErrors(candidate.identifier, input.With(options), bounds);
}

/// Drops those that could not be chosen whatever the blocks say: BIC prefers a simpler one.
void DropOutdone(std::vector<Trial>& trials, double samples) {
  const auto bic = [&](const Trial& one) {
    return Bic(one.MeanSquare(), one.Parameters(), samples);
  };
  std::vector<bool> standing;
  for (const Trial& trial : trials) standing.push_back(trial.dropped.empty());
  for (size_t i = 0; i < trials.size(); ++i) {
    for (size_t j = 0; j < trials.size() && standing[i]; ++j) {
      if (!standing[j] || trials[j].Parameters() >= trials[i].Parameters()) continue;
      if (bic(trials[j]) > bic(trials[i])) continue;
      trials[i].dropped =
          fmt::format("outdone by {}, which is simpler", trials[j].candidate.Name());
      break;
    }
  }
}

/// "nominal-ls law=coulomb 2.3 N.m (1 parameter)" or why it was dropped.
std::string Describe(const Trial& trial, const std::string& unit) {
  const std::string name = trial.candidate.Name();
  if (!trial.errors) return fmt::format("{} ({})", name, trial.dropped);
  return fmt::format("{} {:.4g} {} ({:.3g} parameters)", name, std::sqrt(trial.errors->mean()),
                     unit, trial.Parameters());
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

/// Those that stand on blocks, and a table of all.
struct Comparison {
  std::vector<Contender> contenders;
  std::vector<const Trial*> standing;
  std::string table;
};

/// The trials that were not dropped, on blocks that they have not seen.
Comparison Compare(std::vector<Trial>& trials, const IdentifierInput& input, int blocks) {
  const std::vector<Eigen::Index> bounds = CutIntoBlocks(input.selection, blocks);
  Comparison all;
  for (Trial& trial : trials) {
    if (trial.dropped.empty()) {
      input.Tell(
          fmt::format("comparing on {} held-out blocks: {}", blocks, trial.candidate.Name()));
      trial.errors = ErrorsOf(trial.candidate, input, bounds);
      if (!trial.errors) trial.dropped = "fails without one of the blocks";
    }
    all.table += (all.table.empty() ? "" : "; ") + Describe(trial, input.measurements.torque_unit);
    if (!trial.errors || !trial.errors->allFinite()) continue;
    all.standing.push_back(&trial);
    all.contenders.push_back(
        {trial.candidate.Name(), *trial.errors, trial.MeanSquare(), trial.Parameters()});
  }
  return all;
}

Fit FitChosen(const IdentifierInput& input) {
  const int blocks = input.options.Integer("blocks");
  if (auto why = Unusable(input, 2 * blocks)) return Refused(kName, Status::bad_data, *why);

  // a law can be chosen only where the motion tells the parameters of the plain one apart
  std::vector<Trial> trials;
  const std::vector<Candidate> candidates = Candidates(input.measurements);
  for (const Candidate& candidate : candidates) {
    input.Tell(fmt::format("trying structure {} of {}: {}", trials.size() + 1, candidates.size(),
                           candidate.Name()));
    trials.push_back(Try(candidate, input));
    const Inference& plain = trials[0].told;
    if (plain.status == Status::not_identifiable) {
      return Refused(kName, plain.status, plain.message);
    }
  }
  const auto samples = static_cast<double>(input.selection.count());
  DropOutdone(trials, samples);
  const auto [contenders, standing, table] = Compare(trials, input, blocks);
  if (contenders.empty()) {
    const Inference& plain = trials[0].told;
    const Status status = plain.status == Status::ok ? Status::not_identifiable : plain.status;
    return Refused(kName, status,
                   fmt::format("no structure fits: {}; the first says: {}", table, plain.message));
  }

  // the chosen one's fit, with the reason around what it says
  const Choice choice = ChooseStructure(contenders, samples);
  Fit fit = standing[choice.chosen]->fit;
  fit.identifier = kName;
  fit.summary = fmt::format(
      "{}; {}", Reason(contenders, choice, blocks, input.measurements.torque_unit), fit.summary);
  fit.afterword += ". Tried: " + table;
  return fit;
}

}  // namespace

Identifier Auto() {
  return {kName,
          "chooses law, warming and maps by hold-out, the simplest that is not worse, and says why",
          {{"blocks", "6", "integer >= 3 <= 50", "contiguous parts of the recording to hold out"}},
          &FitChosen};
}

}  // namespace warmjoint::inline identification

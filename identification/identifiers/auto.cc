#include "identification/identifiers/auto.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "identification/fit_data.h"
#include "identification/holdout/blocked_hold_out.h"
#include "identification/holdout/structure_choice.h"

namespace warmjoint::inline identification {
namespace {

constexpr const char* kName = "auto";

/// One structure to try.
struct Candidate {
  std::string identifier;
  std::map<std::string, std::string> given;  // its options

  std::string Name() const {
    std::string name = identifier;
    for (const auto& [key, value] : given) name += fmt::format(" {}={}", key, value);
    return name;
  }
};

/// What became of it.
struct Trial {
  Candidate candidate;
  Estimate estimate;                      // on all the data
  std::string dropped;                    // why it is no contender; empty for one that is
  std::optional<Eigen::VectorXd> errors;  // on blocks, of a contender

  double Parameters() const { return estimate.metrics->effective_parameters; }
  double MeanSquare() const { return estimate.metrics->rmse * estimate.metrics->rmse; }
};

/// Whether the list has such an identifier, with all these options.
bool IsListed(const Candidate& candidate) {
  for (const Identifier& one : Identifiers()) {
    if (one.name != candidate.identifier) continue;
    return std::all_of(candidate.given.begin(), candidate.given.end(), [&](const auto& given) {
      return std::any_of(one.options.begin(), one.options.end(),
                         [&](const OptionInfo& option) { return option.name == given.first; });
    });
  }
  return false;
}

/// All structures, the plain law (2) first.
std::vector<Candidate> Candidates(const Measurements& m) {
  std::vector<Candidate> candidates{{"nominal-ls", {{"law", "viscous_coulomb"}}}};
  for (const char* law : {"coulomb", "asymmetric"}) {
    candidates.push_back({"nominal-ls", {{"law", law}}});
  }
  for (const char* law : {"coulomb", "viscous_coulomb", "asymmetric"}) {
    candidates.push_back({"energy-ml", {{"law", law}}});
  }
  for (const char* warming : {"none", "estimated"}) {
    candidates.push_back({"stribeck", {{"warming", warming}}});
  }
  candidates.push_back({"position-ridge", {}});
  candidates.push_back({"energy-ml", {{"position", "map"}}});
  if (m.gear != 1 || m.motor_position) candidates.push_back({"motor-ridge", {}});
  std::erase_if(candidates, [](const Candidate& candidate) { return !IsListed(candidate); });
  return candidates;
}

/// Calls use(identifier, input) with the candidate's options.
template <typename Use>
auto With(const Candidate& candidate, const IdentifierInput& input, Use&& use) {
  const Identifier& identifier = FindIdentifier(candidate.identifier);
  const Options options(identifier.options, candidate.given, {});
  return use(identifier,
             IdentifierInput{input.measurements, input.selection, options, input.random});
}

/// The candidate on all the data.
Trial Try(const Candidate& candidate, const IdentifierInput& input) {
  Trial trial{candidate, {}, {}, {}};
  trial.estimate = With(candidate, input, [](const Identifier& identifier, const auto& same) {
    return identifier.identify(same);
  });
  const Estimate& estimate = trial.estimate;
  if (estimate.status != Status::ok) {
    trial.dropped = StatusName(estimate.status);
  } else if (!estimate.friction || !estimate.metrics) {
    trial.dropped = "gives no friction";
  }
  return trial;
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
  std::string reason =
      fmt::format("chose {}: RMSE {:.4g} {} on {} blocks of time that each fit has not seen, ",
                  chosen.name, std::sqrt(chosen.errors.mean()), unit, blocks);
  if (choice.chosen == choice.best) return reason + "the least of all";
  return reason + fmt::format("simpler than {} ({:.4g}) and not worse beyond doubt",
                              contenders[choice.best].name,
                              std::sqrt(contenders[choice.best].errors.mean()));
}

Estimate Identify(const IdentifierInput& input) {
  const int blocks = input.options.Integer("blocks");
  if (auto why = Unusable(input, 2 * blocks)) return Failed(kName, Status::bad_data, *why);
  const std::vector<Eigen::Index> bounds = CutIntoBlocks(input.selection, blocks);

  // a law can be chosen only where the motion tells the parameters of the plain one apart
  std::vector<Trial> trials;
  for (const Candidate& candidate : Candidates(input.measurements)) {
    trials.push_back(Try(candidate, input));
    const Estimate& plain = trials[0].estimate;
    if (plain.status == Status::not_identifiable) {
      return Failed(kName, plain.status, plain.message);
    }
  }
  const auto samples = static_cast<double>(input.selection.count());
  DropOutdone(trials, samples);

  // the contenders on blocks that they have not seen
  std::vector<Contender> contenders;
  std::vector<const Trial*> standing;
  std::string table;
  for (Trial& trial : trials) {
    if (trial.dropped.empty()) {
      trial.errors =
          With(trial.candidate, input, [&](const Identifier& identifier, const auto& same) {
            return BlockedErrors(identifier, same, bounds);
          });
      if (!trial.errors) trial.dropped = "fails without one of the blocks";
    }
    table += (table.empty() ? "" : "; ") + Describe(trial, input.measurements.torque_unit);
    if (!trial.errors || !trial.errors->allFinite()) continue;
    standing.push_back(&trial);
    contenders.push_back(
        {trial.candidate.Name(), *trial.errors, trial.MeanSquare(), trial.Parameters()});
  }
  if (contenders.empty()) {
    const Estimate& plain = trials[0].estimate;
    const Status status = plain.status == Status::ok ? Status::not_identifiable : plain.status;
    return Failed(kName, status,
                  fmt::format("no structure fits: {}; the first says: {}", table, plain.message));
  }

  const Choice choice = ChooseStructure(contenders, samples);
  Estimate estimate = standing[choice.chosen]->estimate;
  estimate.identifier = kName;
  estimate.message = fmt::format("{}; {}. Tried: {}",
                                 Reason(contenders, choice, blocks, input.measurements.torque_unit),
                                 estimate.message, table);
  return estimate;
}

}  // namespace

Identifier Auto() {
  return {kName,
          "chooses law, warming and maps by hold-out, the simplest that is not worse, and says why",
          {{"blocks", "6", "integer >= 3 <= 50", "contiguous parts of the recording to hold out"}},
          &Identify};
}

}  // namespace warmjoint::inline identification

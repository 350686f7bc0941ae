// Whether auto chooses the structure that a joint has, on the path that users take.
//
//   structure_study SUITE.yaml [REALIZATIONS [VARIANT]]
//
// For each variant of a suite whose variants are named as in kRight below: how often auto's choice is the variant's own structure, and,
// where it is another, how often that one is significantly worse on a log that neither has seen: the same joint, moved anew. Worse: the
// mean squared errors on 20 blocks of that log, paired, by Student's t, one side, 5 %.
#include <fmt/format.h>
#include <warmjoint/prepared_log.h>

#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "identification/answer/identify.h"
#include "identification/fit/fit_data.h"
#include "identification/fit/seen_samples.h"
#include "identification/holdout/hold_out.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/identifiers/structures.h"
#include "identification/uncertainty/tails.h"
#include "scenarios/suite.h"
#include "sim/plant/plant.h"
#include "tests/studies/for_each_variant.h"

namespace warmjoint {
namespace {

constexpr int kBlocks = 20;
constexpr double kLevel = 0.05;

using Given = std::map<std::string, std::string>;

/// The structure of each kind of joint.
const std::map<std::string, std::pair<std::string, Given>> kRight{
    {"law", {"nominal-ls", {{"law", "viscous_coulomb"}}}},
    {"asymmetric", {"nominal-ls", {{"law", "asymmetric"}}}},
    {"stribeck", {"stribeck", {{"warming", "none"}}}},
    {"asymmetric-stribeck", {"stribeck", {{"law", "asymmetric_stribeck"}, {"warming", "none"}}}},
    {"warming", {"energy-ml", {{"law", "viscous_coulomb"}}}},
    {"gravity", {"nominal-ls", {{"gravity", "sincos"}, {"law", "viscous_coulomb"}}}},
    {"ripple", {"position-ridge", {}}},
    {"motor-ripple", {"motor-ridge", {}}},
    {"warming-with-ripple", {"energy-ml", {{"position", "map"}}}},
    {"lag", {"nominal-ls", {{"law", "viscous_coulomb"}, {"torque_lag", "estimated"}}}},
    {"inertia", {"nominal-ls", {{"law", "viscous_coulomb"}}}}};

/// Mean squared errors of a fit's prediction on blocks of another log; nothing where it predicts nothing.
std::optional<Eigen::VectorXd> ErrorsOn(const PreparedLog& log, const Fit& fit) {
  if (fit.refusal) return std::nullopt;
  const LogView& view = fit.model.inertia ? log.moving() : log.constant_speed();
  const TorquePrediction predicted =
      PredictTorque(fit.model, view.measurements, view.selection, fit.Start());
  const std::vector<Eigen::Index> bounds = CutIntoBlocks(view.selection, kBlocks);
  const Eigen::ArrayXd squares = (view.measurements.torque - predicted.torque).array().square();
  Eigen::VectorXd errors(kBlocks);
  for (int block = 0; block < kBlocks; ++block) {
    const auto first = bounds[static_cast<std::size_t>(block)];
    const auto length = bounds[static_cast<std::size_t>(block) + 1] - first;
    const auto kept = predicted.covered.keep.segment(first, length).cast<double>();
    errors[block] = (squares.segment(first, length) * kept).sum() / std::max(kept.sum(), 1.0);
  }
  return errors;
}

/// Whether the first is worse beyond chance.
bool IsWorse(const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
  const Eigen::VectorXd differences = one - other;
  const double mean = differences.mean();
  const double deviation =
      std::sqrt((differences.array() - mean).square().sum() / (kBlocks - 1) / kBlocks);
  return mean > 0 && PValueOfStudent(mean / deviation, kBlocks - 1) < 2 * kLevel;
}

/// A structure's name without the number and the width of its kernels, which are no part of what a joint is.
std::string WithoutShape(const std::string& name) {
  std::string kept;
  std::istringstream words(name);
  for (std::string word; words >> word;) {
    if (word.starts_with("kernels=") || word.starts_with("width=")) continue;
    kept += kept.empty() ? word : " " + word;
  }
  return kept;
}

/// The fit that auto's message names, made from the same samples.
struct Compared {
  std::string chosen;
  Fit fit;
};

Compared Choose(const PreparedLog& log) {
  const Identifier& identifier = FindIdentifier("auto");
  const IdentifierInput input{log, identifier.options, {}};
  Fit fit = identifier.fit(SelectSamples(identifier, input));
  return {fit.choice ? WithoutShape(fit.choice->chosen) : "nothing", std::move(fit)};
}

Fit FitRight(const Structure& right, const PreparedLog& log) {
  const IdentifierInput input{log, right.identifier.options, {}};
  return right.identifier.fit(SelectSamples(right.identifier, input));
}

void Study(const Suite& suite, int variant, int realizations) {
  const std::string name = suite.ladder->variants[static_cast<size_t>(variant)].name;
  const auto& [identifier, given] = kRight.at(name);
  Structure right{FindIdentifier(identifier)};
  right.identifier.options = right.identifier.options.Read(given);
  // the names of auto's structures tell these even where they are as usual
  for (const char* option : {"law", "warming"}) {
    if (given.contains(option)) right.named_option = option;
  }
  const Scenario scenario = VariantScenario(suite, variant);
  const std::unique_ptr<Plant> plant = MakePlant(scenario);
  int as_it_is = 0, worse = 0;
  std::map<std::string, int> others;
  for (int r = 0; r < realizations; ++r) {
    const Simulation recording = plant->Run(static_cast<std::uint64_t>(r));
    const PreparedLog log = Prepare(recording.measurements);
    const Compared choice = Choose(log);
    if (choice.chosen == right.Name()) {
      ++as_it_is;
      continue;
    }
    ++others[choice.chosen];

    const PreparedLog unseen =
        Prepare(MovedAnew(scenario, recording.truth, realizations + r).measurements);
    const auto ours = ErrorsOn(unseen, choice.fit), best = ErrorsOn(unseen, FitRight(right, log));
    if (best && (!ours || IsWorse(*ours, *best))) ++worse;
  }
  fmt::print("{:20} right {} of {}, significantly worse {}\n", name, as_it_is, realizations, worse);
  for (const auto& [other, count] : others) fmt::print("    {:3} {}\n", count, other);
  std::fflush(stdout);
}

}  // namespace
}  // namespace warmjoint

int main(int count, char** arguments) {
  return warmjoint::StudyVariants("structure_study", count, arguments, warmjoint::Study);
}

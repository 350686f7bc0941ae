// Whether a bound on what may pass as coloured noise would refuse wrong answers that other tests let pass.
//
//   colour_study SUITE.yaml [REALIZATIONS [VARIANT...]]
//
// The bound: an rms of the residual far above the sample-to-sample noise (rms of differences of neighbours
// over sqrt 2), with a correlation at the lag of one hold that has not died. For each variant and each bound
// on the two: of the answers that are ok with intervals, how many it would refuse, and how many of them are
// confidently wrong. On clean logs what it refuses are false alarms.
#include <fmt/format.h>
#include <warmjoint/prepared_log.h>
#include <warmjoint/score.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "identification/answer/identify.h"
#include "identification/fit/fit_data.h"
#include "identification/identifiers/identifier_list.h"
#include "models/foundation/robust_noise.h"
#include "scenarios/suite.h"
#include "sim/plant/plant.h"
#include "tests/studies/for_each_variant.h"

namespace warmjoint {
namespace {

struct Bound {
  double ratio;        // rms over the sample-to-sample noise
  double correlation;  // at the lag of one hold
};
constexpr std::array kBounds{Bound{1.5, 0.1}, Bound{1.5, 0.3}, Bound{2, 0.1}, Bound{3, 0.1},
                             Bound{5, 0.1}};

/// What the bound looks at, of one residual.
struct Colour {
  double ratio = 1, correlation = 0;

  bool Exceeds(const Bound& bound) const {
    return ratio > bound.ratio && correlation > bound.correlation;
  }
};

/// Samples of the median hold; 0 where no holds are known.
Eigen::Index MedianHold(const Selection& selection) {
  Eigen::VectorXd counts(static_cast<Eigen::Index>(selection.segments.size()));
  for (size_t i = 0; i < selection.segments.size(); ++i) {
    const Segment& one = selection.segments[i];
    counts[static_cast<Eigen::Index>(i)] = static_cast<double>(one.end - one.begin);
  }
  return counts.size() > 0 ? static_cast<Eigen::Index>(MedianInPlace(counts)) : 0;
}

Colour ColourOf(const Fit& fit) {
  const Eigen::VectorXd residual = fit.rows.residual();
  Eigen::VectorXd all = Eigen::VectorXd::Zero(fit.rows.used.keep.size());
  for (Eigen::Index i = 0, row = 0; i < all.size(); ++i) {
    if (fit.rows.used.keep[i]) all[i] = residual[row++];
  }
  double differences = 0, pairs = 0, products = 0, far_pairs = 0;
  const Eigen::Index hold = MedianHold(fit.rows.used);
  for (Eigen::Index i = 1; i < all.size(); ++i) {
    if (!fit.rows.used.keep[i]) continue;
    if (fit.rows.used.keep[i - 1]) {
      differences += std::pow(all[i] - all[i - 1], 2);
      ++pairs;
    }
    if (hold > 0 && i >= hold && fit.rows.used.keep[i - hold]) {
      products += all[i] * all[i - hold];
      ++far_pairs;
    }
  }
  const double variance = residual.squaredNorm() / static_cast<double>(residual.size());
  Colour colour;
  if (differences > 0) colour.ratio = std::sqrt(variance / (differences / pairs / 2));
  if (far_pairs > 0) colour.correlation = products / far_pairs / variance;
  return colour;
}

/// Whether an answer gives intervals, and whether one is far from the truth.
struct Verdict {
  bool told = false, wrong = false;
};

Verdict VerdictOf(const Estimate& estimate, const Simulation& recording, const PreparedLog& log) {
  Verdict verdict;
  if (estimate.status != Status::ok) return verdict;
  const LogView& view = ScoredView(estimate, log);
  const Score score = ScoreEstimate(estimate, view.measurements, view.selection, recording.truth);
  for (const ParameterScore& one : score.continuous) {
    if (!one.covered) continue;
    verdict.told = true;
    verdict.wrong = verdict.wrong || IsFarOutside(one, *estimate.Find(one.name)->interval95);
  }
  return verdict;
}

void Study(const Suite& suite, int variant, int realizations) {
  const std::unique_ptr<Plant> plant = MakePlant(VariantScenario(suite, variant));
  for (const SuiteIdentifier& one : suite.identifiers) {
    const Identifier& identifier = FindIdentifier(one.name);
    int told = 0, wrong = 0;
    std::array<int, kBounds.size()> refused{}, refused_wrong{};
    for (int r = 0; r < realizations; ++r) {
      const Simulation recording = plant->Run(static_cast<std::uint64_t>(r));
      const PreparedLog log = Prepare(recording.measurements);
      const IdentifierInput input{log, identifier.options.Read(one.options, {one.label}), {}};
      const Answer answer = FitAndCheck(identifier, input);
      const Verdict verdict = VerdictOf(ReportAnswer(identifier, input, answer), recording, log);
      if (!verdict.told) continue;
      ++told;
      wrong += verdict.wrong;
      const Colour colour = ColourOf(answer.fit);
      for (size_t b = 0; b < kBounds.size(); ++b) {
        if (!colour.Exceeds(kBounds[b])) continue;
        ++refused[b];
        refused_wrong[b] += verdict.wrong;
      }
    }
    fmt::print(
        "{:32} {:11} told {:3} wrong {:3}",
        suite.ladder ? suite.ladder->variants[static_cast<size_t>(variant)].name : suite.name,
        one.label, told, wrong);
    for (size_t b = 0; b < kBounds.size(); ++b) {
      fmt::print("  | {}, {}: refuses {:3}, wrong {:3}", kBounds[b].ratio, kBounds[b].correlation,
                 refused[b], refused_wrong[b]);
    }
    fmt::print("\n");
  }
  std::fflush(stdout);
}

}  // namespace
}  // namespace warmjoint

int main(int count, char** arguments) {
  return warmjoint::StudyVariants("colour_study", count, arguments, warmjoint::Study);
}

#include <warmjoint/score.h>

#include <cmath>
#include <limits>

#include "identification/fit/fit_parameters.h"
#include "identification/fit/seen_samples.h"
#include "identification/gravity.h"
#include "identification/linear/rigid_part.h"
#include "identification/score/cramer_rao.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/robust_noise.h"
#include "models/friction/thermal.h"

namespace warmjoint {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

ParameterScore ScoreOne(std::string_view name, double truth, const Estimate& estimate) {
  ParameterScore score;
  score.name = name;
  score.truth = truth;
  score.bound = kNone;
  // parameters that the estimate lacks count as 0
  if (const EstimatedParameter* found = estimate.Find(score.name)) {
    score.estimated = true;
    score.estimate = found->value;
    score.interval95 = found->interval95;
    if (found->interval95) {
      const auto [lower, upper] = *found->interval95;
      score.covered = lower <= truth && truth <= upper;
    }
  }
  if (truth != 0) score.relative_error = (score.estimate - truth) / std::abs(truth);
  return score;
}

/// Parameters for which the relative error (26) exists.
std::vector<ParameterScore> Relative(const std::vector<ParameterScore>& all) {
  std::vector<ParameterScore> relative;
  for (const ParameterScore& one : all) {
    if (one.truth != 0) relative.push_back(one);
  }
  return relative;
}

double BoundNpe(const std::vector<ParameterScore>& all) {
  double sum = 0;
  for (const ParameterScore& one : Relative(all)) sum += std::pow(one.bound / one.truth, 2);
  return std::sqrt(sum);
}

/// Columns of the other parameters of a fit to motion of any kind: inertia, and gravity where it was fitted.
Eigen::MatrixXd Nuisance(const Estimate& estimate, const LogSamples& m) {
  if (!m.acceleration) return {};
  if (!estimate.gravity) return *m.acceleration;
  const GravityModel& gravity = *estimate.gravity;
  return ConcatColumns(GravityColumns(gravity.kind, gravity.knots, m.position), *m.acceleration);
}

}  // namespace

std::vector<ParameterScore> ScoreParameters(const Estimate& estimate, const Friction& truth) {
  // the law, then the warming
  std::vector<ParameterScore> scores;
  for (const ParameterInfo& info : FindLaw(truth.law)->parameters) {
    scores.push_back(ScoreOne(info.name, truth.parameters.at(std::string(info.name)), estimate));
  }
  if (!truth.thermal) return scores;
  scores.push_back(ScoreOne(kGainName, truth.thermal->gain, estimate));
  scores.push_back(ScoreOne(kTimeConstantName, truth.thermal->time_constant, estimate));
  return scores;
}

double ParameterError(const std::vector<ParameterScore>& parameters) {
  const std::vector<ParameterScore> scores = Relative(parameters);
  Eigen::VectorXd estimate(scores.size()), truth(scores.size());
  for (size_t i = 0; i < scores.size(); ++i) {
    estimate[i] = scores[i].estimate;
    truth[i] = scores[i].truth;
  }
  return NormalisedParameterError(estimate, truth);
}

const LogView& ScoredView(const Estimate& estimate, const PreparedLog& log) {
  // a bristle is determined by the changes of speed, which only the raw view has as they were
  if (Find(LawPart::bristle, estimate)) return log.raw();
  return SeenByModel(ValueOf(Role::inertia, estimate), View::raw, log);
}

Score ScoreEstimate(const Estimate& estimate, const LogSamples& measurements,
                    const Selection& selection, const Truth& truth) {
  Score score;
  score.continuous = score.discrete = ScoreParameters(estimate, truth.friction);
  const double step = MedianStep(measurements.time);
  // the warming, as it is and over one sampling interval
  if (truth.friction.thermal) {
    const DiscreteThermal discrete = Discretise(*truth.friction.thermal, step);
    const std::size_t law = score.discrete.size() - 2;
    score.discrete[law] = ScoreOne(kDiscreteGainName, discrete.gain, estimate);
    score.discrete[law + 1] = ScoreOne(kPoleName, discrete.pole, estimate);
  }

  // the bound for any unbiased estimate, in which E(0) is unknown where it was estimated
  const auto known = Find(Role::start, estimate) ? KnownInitialEnergy::no : KnownInitialEnergy::yes;
  const CramerRao bound =
      CramerRaoBound(measurements, selection, truth, known, step, Nuisance(estimate, measurements));
  for (size_t i = 0; i < score.continuous.size(); ++i) {
    score.continuous[i].bound = bound.continuous[i];
    score.discrete[i].bound = bound.discrete[i];
  }

  // all parameters together
  score.npe_continuous = ParameterError(score.continuous);
  score.npe_discrete = ParameterError(score.discrete);
  score.bound_npe_continuous = BoundNpe(score.continuous);
  score.bound_npe_discrete = BoundNpe(score.discrete);
  return score;
}

Score ScoreEstimate(const Estimate& estimate, const PreparedLog& log, const Truth& truth) {
  const auto& [measurements, selection] = ScoredView(estimate, log);
  if (measurements.size() != truth.force.size()) {
    Refuse({measurements.source},
           "has {} samples and its truth {}; give the truth of this recording", measurements.size(),
           truth.force.size());
  }
  return ScoreEstimate(estimate, measurements, selection, truth);
}

double NormalisedParameterError(const Eigen::VectorXd& estimate, const Eigen::VectorXd& truth) {
  if (estimate.size() != truth.size() || (truth.array() == 0).any()) {
    Refuse({"truth"}, "has {} values for {} of the estimate; give as many, none of them 0",
           truth.size(), estimate.size());
  }
  return ((estimate - truth).array() / truth.array().abs()).matrix().norm();
}

}  // namespace warmjoint

// An estimate against the truth: errors, coverage, and the bound that no unbiased estimate beats.
//
//   const Simulation simulation = Simulate("scenario.yaml");
//   const PreparedLog log = Prepare(simulation.measurements);
//   const Score score = ScoreEstimate(Identify(log), log, simulation.truth);
//   std::printf("NPE %.1f %%\n", 100 * score.npe_continuous);
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>
#include <warmjoint/simulation.h>

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace warmjoint {

/// One parameter of the truth.
struct ParameterScore {
  std::string name;
  double truth = 0;
  double estimate = 0;  // 0 where not estimated
  bool estimated = false;
  std::optional<bool> covered;  // the 95 % interval holds the truth; empty without an interval
  double bound = 0;             // Cramer-Rao standard deviation; NaN where it does not exist
  std::optional<std::array<double, 2>> interval95 = {};  // of the estimate
  // (estimate - truth) / |truth|; empty where the truth is 0
  std::optional<double> relative_error = {};

  template <class A>
  void Serialize(A* a) {
    a->Field("truth", &truth);
    a->Field("estimate", &estimate);
    a->Field("estimated", &estimated);
    a->Field("interval95", &interval95);
    a->Field("covered", &covered);
    a->Field("relative_error", &relative_error);
    a->Field("bound", &bound);
  }
};

/// Scores in two parametrisations, Eqs. (21) and (22) of the warming, and their NPE, Eq. (26).
struct Score {
  std::vector<ParameterScore> continuous;  // law, thermal_gain, thermal_time_constant
  std::vector<ParameterScore> discrete;    // law, thermal_gain_discrete, thermal_pole
  double npe_continuous = 0;
  double npe_discrete = 0;
  double bound_npe_continuous = 0;  // sqrt(sum((bound / truth)^2)): rms NPE at the bound, or NaN
  double bound_npe_discrete = 0;

  template <class A>
  void Serialize(A* a) {
    a->Named("continuous", &continuous);
    a->Named("discrete", &discrete);
    a->Field("npe_continuous", &npe_continuous);
    a->Field("npe_discrete", &npe_discrete);
    a->Field("bound_npe_continuous", &bound_npe_continuous);
    a->Field("bound_npe_discrete", &bound_npe_discrete);
  }
};

/// The samples that an estimate is scored on: those of the log as it was taken at constant speed, or
/// all samples at which the joint moves where it took motion of any kind.
const LogView& ScoredView(const Estimate& estimate, const PreparedLog& log);

/// An estimate compared with a true friction, in the continuous parametrisation and without bounds: all that can be
/// computed without the log.
std::vector<ParameterScore> ScoreParameters(const Estimate& estimate, const Friction& truth);

/// NPE, Eq. (26), of those whose truth is not 0.
double ParameterError(const std::vector<ParameterScore>& parameters);

/// Scores an estimate of measurements that were made with `truth`. Parameters are matched by
/// name: one of the truth that the estimate lacks (another law's, or the thermal ones of an
/// identifier without warming) counts as estimated 0 in the NPE. Parameters whose truth is 0 are
/// listed but left out of the NPE, which is relative. The discrete pair is that of the recording's
/// median sampling interval, for truth and estimate alike. The bounds count
/// E(0) as known unless the estimate holds it; with an acceleration, inertia and the gravity that was
/// fitted count as unknown.
Score ScoreEstimate(const Estimate& estimate, const LogSamples& measurements,
                    const Selection& selection, const Truth& truth);

/// The same on the samples that the estimate is scored on (ScoredView). Throws BadInput where log and truth have unlike
/// lengths.
Score ScoreEstimate(const Estimate& estimate, const PreparedLog& log, const Truth& truth);

/// NPE = sqrt(sum_i ((estimate_i - truth_i) / |truth_i|)^2), Eq. (26); 0.05 is 5 %.
/// estimate, truth: [d], the same parameters in the same order. Throws BadInput for unlike lengths and a truth of 0.
double NormalisedParameterError(const Eigen::VectorXd& estimate, const Eigen::VectorXd& truth);

}  // namespace warmjoint

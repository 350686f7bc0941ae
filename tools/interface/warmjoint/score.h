// An estimate against the truth.
//
//   const Simulation simulation = Simulate("scenario.yaml");
//   const PreparedLog log(simulation.recording);
//   const Score score = ScoreEstimate(Identify(log), log, simulation.truth);
//   std::printf("NPE %.1f %%\n", 100 * score.npe_continuous);
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/simulate.h>

namespace warmjoint::api {

/// One parameter of the truth.
struct ParameterScore {
  std::string name;
  double truth = 0;
  double estimate = 0;  // 0 where it is not estimated
  bool estimated = false;
  std::optional<bool> covered{};  // the 95 % interval holds the truth; none without an interval
  double bound = 0;               // Cramer-Rao standard deviation; NaN where it does not exist
};

/// Scores in two parametrisations of the warming.
struct Score {
  std::vector<ParameterScore> continuous{};  // law, thermal_gain, thermal_time_constant
  std::vector<ParameterScore> discrete{};    // law, thermal_gain_discrete, thermal_pole
  double npe_continuous = 0;                 // normalised parameter error, Eq. (26): 0.05 is 5 %
  double npe_discrete = 0;
  double bound_npe_continuous = 0;  // rms NPE of an estimate at the Cramer-Rao bound, or NaN
  double bound_npe_discrete = 0;
  std::optional<Metrics> metrics{};  // RMSE, MAE, Fit and FPE of the estimate on its own log
};

/// Scores an estimate of the log behind which `truth` stands, as suites do. A parameter of the truth that the estimate lacks
/// counts as estimated 0. Throws BadInput where log and truth have unlike lengths.
Score ScoreEstimate(const Estimate& estimate, const PreparedLog& log, const Truth& truth);

/// NPE = sqrt(sum_i ((estimate_i - truth_i) / |truth_i|)^2). estimate, truth: [d], in one order, no truth 0. Throws
/// BadInput for unlike lengths and a truth of 0.
double NormalisedParameterError(const std::vector<double>& estimate,
                                const std::vector<double>& truth);

/// RMSE, MAE, Fit and FPE. measured, fitted: [n] N.m or N, n above `parameters`, the number of fitted ones. effective: their
/// effective number where a fit was penalised. Throws BadInput for unlike lengths and no sample.
Metrics ComputeMetrics(const std::vector<double>& measured, const std::vector<double>& fitted,
                       int parameters, std::optional<double> effective = {});

}  // namespace warmjoint::api

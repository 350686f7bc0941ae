#include "identification/score/score.h"

#include <warmjoint/score.h>

#include "identification/score/npe.h"
#include "tools/interface/convert_estimate.h"
#include "tools/interface/convert_numbers.h"
#include "tools/interface/convert_recording.h"
#include "tools/interface/convert_truth.h"
#include "tools/interface/guarded.h"

namespace warmjoint::api {
namespace {

std::vector<ParameterScore> FromScores(const std::vector<identification::ParameterScore>& scores) {
  std::vector<ParameterScore> made;
  for (const identification::ParameterScore& one : scores) {
    made.push_back({one.name, one.truth, one.estimate, one.estimated, one.covered, one.bound});
  }
  return made;
}

void RequireLike(const std::vector<double>& a, const std::vector<double>& b, const char* names) {
  if (a.size() == b.size() && !a.empty()) return;
  models::Refuse({names}, "have {} and {} values; give as many of both, at least one", a.size(),
                 b.size());
}

}  // namespace

Score ScoreEstimate(const Estimate& estimate, const PreparedLog& log, const Truth& truth) {
  return Guarded([&] {
    // the truth is of these samples
    const auto& [measurements, selection] = log.state().log.taken();
    if (static_cast<std::size_t>(measurements.size()) != truth.force.size()) {
      models::Refuse({measurements.source},
                     "has {} samples and its truth {}; give the truth of this recording",
                     measurements.size(), truth.force.size());
    }

    // the suites' own score
    const identification::Score made = identification::ScoreEstimate(
        ToEstimate(estimate), measurements, selection, ToTruth(truth));
    return Score{FromScores(made.continuous),
                 FromScores(made.discrete),
                 made.npe_continuous,
                 made.npe_discrete,
                 made.bound_npe_continuous,
                 made.bound_npe_discrete,
                 estimate.metrics};
  });
}

double NormalisedParameterError(const std::vector<double>& estimate,
                                const std::vector<double>& truth) {
  return Guarded([&] {
    // relative errors, of which there are none of 0
    RequireLike(estimate, truth, "estimate and truth");
    for (const double value : truth) {
      if (value == 0) models::Refuse({"truth"}, "holds 0, of which there is no relative error");
    }
    return identification::NormalisedParameterError(ToEigen(estimate), ToEigen(truth));
  });
}

Metrics ComputeMetrics(const std::vector<double>& measured, const std::vector<double>& fitted,
                       int parameters, std::optional<double> effective) {
  return Guarded([&] {
    RequireLike(measured, fitted, "measured and fitted");
    // a fit leaves freedom
    if (parameters < 0 || static_cast<std::size_t>(parameters) >= measured.size()) {
      models::Refuse({"parameters"}, "is {}; it must be at least 0 and below the {} samples",
                     parameters, measured.size());
    }
    return FromMetrics(identification::ComputeMetrics(ToEigen(measured), ToEigen(fitted),
                                                      parameters, effective.value_or(parameters)));
  });
}

}  // namespace warmjoint::api

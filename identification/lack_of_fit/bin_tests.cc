#include "identification/lack_of_fit/bin_tests.h"

#include <fmt/format.h>

#include <algorithm>

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;

constexpr Index kRowsAColumn = 3;

/// One test that is still open, with its features beside the present fit.
struct Open {
  const LackOfFitTest* test;
  Finding* finding;
  Features features;
};

/// The tests that there are rows for; the others say why not.
std::vector<Open> Affordable(const std::vector<const LackOfFitTest*>& tests, const Bins& bins,
                             const Circumstances& known, const GrowingFit& fit, Index columns,
                             std::vector<Finding>& findings) {
  std::vector<Open> open;
  for (size_t i = 0; i < tests.size(); ++i) {
    findings[i].test = tests[i];
    Features features = tests[i]->features(bins, known, fit);
    const Index more = features.columns.cols();
    if (more == 0) {
      findings[i].reason = tests[i]->absent;
    } else if (kRowsAColumn * (columns + more) > bins.size()) {
      findings[i].reason = fmt::format("{} samples or segments are too few for it", bins.size());
    } else {
      columns += more;
      open.push_back({tests[i], &findings[i], std::move(features)});
    }
  }
  return open;
}

/// Makes a test beside the present fit.
void Make(const Open& open, const GrowingFit& fit, const ErrorLevel& level) {
  Finding made = fit.Test(open.features);
  made.test = open.test;
  if (!made.made) made.reason = kHeldByTheFit;
  made.p_adjusted = level.Adjusted(made.p);
  *open.finding = std::move(made);
}

}  // namespace

BinFindings TestBins(const std::vector<const LackOfFitTest*>& tests, const Bins& bins,
                     const Eigen::VectorXd& residual, const Eigen::MatrixXd& derivatives,
                     const Circumstances& known, ErrorLevel& level) {
  const Selection all{Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(bins.size(), true), {}};
  GrowingFit fit(bins.weight, residual, derivatives, all);
  BinFindings result;
  result.findings.resize(tests.size());
  std::vector<Open> open = Affordable(tests, bins, known, fit, derivatives.cols(), result.findings);
  std::vector<Features> asked;
  for (const Open& one : open) asked.push_back(one.features);
  fit.LearnNoise(asked);

  while (!open.empty()) {
    // the test that rejects with the largest gain
    size_t best = open.size();
    for (size_t i = 0; i < open.size(); ++i) {
      Make(open[i], fit, level);
      if (!level.WouldReject(open[i].finding->p) || open[i].finding->explained <= 0) continue;
      if (best == open.size() || open[i].finding->gain > open[best].finding->gain) best = i;
    }
    if (best == open.size()) break;

    // joins the fit; scans look for their best candidate beside it
    open[best].finding->rejected = level.Rejects(open[best].finding->p);
    fit.Take(open[best].features);
    open.erase(open.begin() + static_cast<std::ptrdiff_t>(best));
    for (Open& one : open) {
      if (one.features.candidates > 1) one.features = one.test->features(bins, known, fit);
    }
  }
  result.explained = fit.Explained();
  return result;
}

}  // namespace warmjoint::inline identification

#include "identification/lack_of_fit/bin_tests.h"

#include <fmt/format.h>

#include <algorithm>

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr Index kRowsAColumn = 3;

/// The tests that are still open, with their features beside the present fit.
struct Open {
  std::vector<const LackOfFitTest*> tests;
  std::vector<Finding*> findings;
  std::vector<Features> features;

  size_t size() const { return tests.size(); }
  void Close(size_t i) {
    const auto at = static_cast<std::ptrdiff_t>(i);
    tests.erase(tests.begin() + at);
    findings.erase(findings.begin() + at);
    features.erase(features.begin() + at);
  }
};

/// The tests that there are rows for; the others say why not.
Open Affordable(const std::vector<const LackOfFitTest*>& tests, const Bins& bins,
                const Circumstances& known, const GrowingFit& fit, Index columns,
                std::vector<Finding>& findings) {
  Open open;
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
      open.tests.push_back(tests[i]);
      open.findings.push_back(&findings[i]);
      open.features.push_back(std::move(features));
    }
  }
  return open;
}

/// Makes a test beside the present fit.
void Make(const Open& open, size_t i, const GrowingFit& fit, const ErrorLevel& level) {
  Finding made = fit.Test(open.features[i]);
  made.test = open.tests[i];
  if (!made.made) made.reason = kHeldByTheFit;
  made.p_adjusted = level.Adjusted(made.p);
  *open.findings[i] = std::move(made);
}

}  // namespace

BinFindings TestBins(const std::vector<const LackOfFitTest*>& tests, const Bins& bins,
                     const Eigen::VectorXd& residual, const Eigen::MatrixXd& derivatives,
                     const Circumstances& known, ErrorLevel& level) {
  const Selection all{Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(bins.size(), true), {}};
  GrowingFit fit(bins.weight, residual, derivatives, all);
  BinFindings result;
  result.findings.resize(tests.size());
  Open open = Affordable(tests, bins, known, fit, derivatives.cols(), result.findings);
  fit.LearnNoise(open.features);

  while (open.size() > 0) {
    // the test that rejects with the largest gain
    size_t best = open.size();
    for (size_t i = 0; i < open.size(); ++i) {
      Make(open, i, fit, level);
      const Finding& made = *open.findings[i];
      if (!level.WouldReject(made.p) || made.explained <= 0) continue;
      if (best == open.size() || made.gain > open.findings[best]->gain) best = i;
    }
    if (best == open.size()) break;

    // joins the fit; scans look for their best candidate beside it
    open.findings[best]->rejected = level.Rejects(open.findings[best]->p);
    fit.Take(open.features[best]);
    open.Close(best);
    for (size_t i = 0; i < open.size(); ++i) {
      if (open.features[i].candidates == 1) continue;
      open.features[i] = open.tests[i]->features(bins, known, fit);
    }
  }
  result.explained = fit.Explained();
  return result;
}

}  // namespace warmjoint

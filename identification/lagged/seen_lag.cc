#include "identification/lagged/seen_lag.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "identification/lagged/lag_search.h"
#include "identification/uncertainty/tails.h"

namespace warmjoint {
namespace {

constexpr int kFewestRuns = 4;

}  // namespace

SeenLag LookForLag(const LaggedRows& rows, const Eigen::VectorXd& torque,
                   const Eigen::VectorXd& residual) {
  const KeptRuns& all = *rows.runs();
  const Eigen::VectorXd held = rows.InitialStates(residual).col(0);

  // each run that follows another one closely
  std::vector<double> drops, begins;
  for (std::size_t r = 1; r < all.runs.size(); ++r) {
    const KeptRun &before = all.runs[r - 1], &run = all.runs[r];
    const double pause = all.time[run.begin] - all.time[before.end - 1];
    const double lasted = all.time[before.end - 1] - all.time[before.begin];
    // three samples at least, behind a pause no longer than the run before it
    if (run.size() < 3 || pause > lasted) continue;
    drops.push_back(torque[before.end - 1] - torque[run.begin]);
    begins.push_back(held[static_cast<Eigen::Index>(r)]);
  }
  SeenLag seen;
  seen.runs = static_cast<int>(drops.size());
  if (seen.runs < kFewestRuns) return seen;

  // the share of the drop, and how sure it is
  const Eigen::Map<const Eigen::VectorXd> x(drops.data(), seen.runs), y(begins.data(), seen.runs);
  seen.share = x.dot(y) / x.squaredNorm();
  const double degrees_of_freedom = seen.runs - 1;
  const double deviation =
      std::sqrt((y - seen.share * x).squaredNorm() / degrees_of_freedom / x.squaredNorm());
  const double t = seen.share / deviation;
  seen.p = std::isnan(t) ? 1 : std::min(1.0, kLagsTried * PValueOfStudent(t, degrees_of_freedom));
  return seen;
}

bool ShowsLag(const std::shared_ptr<const KeptRuns>& runs, const Eigen::VectorXd& torque,
              const Eigen::VectorXd& residual) {
  const LagRange range = LagsOf(*runs);
  if (!(range.shortest > 0)) return false;
  // at any of the time constants that a search would try
  return std::ranges::any_of(range.Tried(), [&](double lag) {
    return LookForLag(LaggedRows(runs, lag), torque, residual).IsSeen();
  });
}

}  // namespace warmjoint

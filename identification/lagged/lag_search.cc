#include "identification/lagged/lag_search.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <vector>

#include "identification/uncertainty/tails.h"

namespace warmjoint {
namespace {

constexpr int kBits = 20;  // 1e-6
constexpr std::uintmax_t kMostFits = 40;

constexpr int kFewestRuns = 4;

}  // namespace

LagRange LagsOf(const KeptRuns& runs) {
  const double step = runs.Step();
  return {step / 8, std::max(runs.Duration(), step)};
}

std::vector<double> LagRange::Tried() const {
  std::vector<double> lags;
  const double ratio = std::pow(longest / shortest, 1.0 / (kLagsTried - 1));
  for (int i = 0; i < kLagsTried; ++i) lags.push_back(shortest * std::pow(ratio, i));
  return lags;
}

std::optional<double> FindLag(const LagRange& range, const std::function<double(double)>& squares) {
  // no run holds two samples
  if (!(range.shortest > 0)) return std::nullopt;

  // the best of those that are tried
  const std::vector<double> tried = range.Tried();
  std::vector<double> left;
  for (const double lag : tried) left.push_back(squares(lag));
  const auto best = static_cast<std::size_t>(std::ranges::min_element(left) - left.begin());
  if (!std::isfinite(left[best])) return std::nullopt;

  // refined between its neighbours
  const double below = tried[best > 0 ? best - 1 : 0];
  const double above = tried[std::min(best + 1, tried.size() - 1)];
  std::uintmax_t fits = kMostFits;
  const auto [at, least] = boost::math::tools::brent_find_minima(
      [&](double logarithm) { return squares(std::exp(logarithm)); }, std::log(below),
      std::log(above), kBits, fits);

  // a lag at an end of the range is none that the log tells
  const double lag = std::exp(at);
  if (!std::isfinite(least) || !range.Holds(lag)) return std::nullopt;
  return lag;
}

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

#include "identification/lagged/lag_search.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "identification/fit/fit_data.h"
#include "identification/model/minimise.h"
#include "identification/model/normal_equations.h"
#include "identification/uncertainty/tails.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSlopeStep = 1e-5;  // of log T; why: half of the digits of a double

constexpr int kFewestRuns = 4;
constexpr double kLagByChance = 1e-3;  // of logs

/// How many time constants, in a geometric series, are tried before the best is refined.
constexpr int kLagsTried = 14;

/// Time constants between which a lag can be determined, s: from an eighth of a sampling interval, whose
/// e^-8 no sample shows, to the duration of a run, beyond which what it holds looks like a drift of the run.
struct LagRange {
  double shortest = 0, longest = 0;

  /// kLagsTried of them, the shortest first; none where no run holds two samples.
  std::vector<double> Tried() const {
    std::vector<double> lags;
    if (!(shortest > 0)) return lags;
    const double ratio = std::pow(longest / shortest, 1.0 / (kLagsTried - 1));
    for (int i = 0; i < kLagsTried; ++i) lags.push_back(shortest * std::pow(ratio, i));
    return lags;
  }
  /// Whether a lag lies within and at neither end.
  bool Holds(double lag) const { return lag > 1.01 * shortest && lag < 0.99 * longest; }
};

LagRange LagsOf(const KeptRuns& runs) {
  const double step = runs.Step();
  return {step / 8, std::max(runs.Duration(), step)};
}

}  // namespace

std::optional<double> FindLag(const KeptRuns& runs, const std::function<double(double)>& squares,
                              const std::function<double(double, const LagBracket&)>& refine) {
  const LagRange range = LagsOf(runs);
  const std::vector<double> tried = range.Tried();
  if (tried.empty()) return std::nullopt;
  // the best of those that are tried
  std::vector<double> left;
  for (const double lag : tried) left.push_back(squares(lag));
  const auto best = static_cast<std::size_t>(std::ranges::min_element(left) - left.begin());
  if (!std::isfinite(left[best]) || !std::isfinite(squares(tried[best]))) return std::nullopt;

  // refined between its neighbours
  const double lag = refine(
      tried[best], {tried[best > 0 ? best - 1 : 0], tried[std::min(best + 1, tried.size() - 1)]});
  // a lag at an end of the range is not one that the log determines
  if (!range.Holds(lag)) return std::nullopt;
  return lag;
}

double RefineLag(const Model& model, const VectorXd& x, const ModelSamples& samples,
                 double variance, const RowsOfLag& rows_of, double lag, const LagBracket& bracket) {
  const Index p = model.size();
  ModelSamples none = samples;
  none.torque.setZero();
  const VectorXd measured = Kept(samples.torque, {samples.keep, {}});
  SquaresProblem problem;
  problem.sums = [&](const VectorXd& at) -> RowSums {
    // the model before any lag
    ModelRows::Rows here = RowsToFit(ModelAt(model, at.head(p)), none);
    const VectorXd force = -here.col(p);
    const auto left_by = [&](double trial) -> VectorXd {
      const LaggedRows rows = rows_of(trial);
      return rows.Of(rows.BeforeLag(measured) - force);
    };
    // its rows after the lag, the column of log T by central differences, and what is left
    const double T = std::exp(at[p]);
    const LaggedRows lagged = rows_of(T);
    here.col(p) = lagged.BeforeLag(measured) - force;
    lagged.Apply(here);
    RowTransform::Rows rows(here.rows(), p + 2);
    rows << here.leftCols(p),
        (left_by(T * std::exp(-kSlopeStep)) - left_by(T * std::exp(kSlopeStep))) / (2 * kSlopeStep),
        here.col(p);
    const MatrixXd products = GramOf(rows) / variance;
    RowSums sums{products.topLeftCorner(p + 1, p + 1), products.col(p + 1).head(p + 1),
                 products(p + 1, p + 1)};
    AddPriors(model, at.head(p), sums);
    return sums;
  };
  problem.lower = VectorXd::Constant(p + 1, -kInfinity);
  problem.upper = VectorXd::Constant(p + 1, kInfinity);
  problem.lower[p] = std::log(bracket.below);
  problem.upper[p] = std::log(bracket.above);
  VectorXd start(p + 1);
  start << x, std::log(lag);
  return std::exp(Minimise(problem, std::move(start)).x[p]);
}

bool SeesLag(const LaggedRows& rows, const Eigen::VectorXd& torque,
             const Eigen::VectorXd& residual) {
  const KeptRuns& all = *rows.runs();
  const Eigen::VectorXd held = rows.InitialStates(residual).col(0);

  // each run that follows another one closely
  std::vector<double> drops, begins;
  for (std::size_t r = 1; r < all.runs.size(); ++r) {
    const SampleRange &before = all.runs[r - 1], &run = all.runs[r];
    const double pause = all.time[run.first] - all.time[before.end() - 1];
    const double lasted = all.time[before.end() - 1] - all.time[before.first];
    // three samples at least, after a pause no longer than the run before it
    if (run.count < 3 || pause > lasted) continue;
    drops.push_back(torque[before.end() - 1] - torque[run.first]);
    begins.push_back(held[static_cast<Eigen::Index>(r)]);
  }
  const auto count = std::ssize(drops);
  if (count < kFewestRuns) return false;

  // the share of the drop, and its standard error
  const Eigen::Map<const Eigen::VectorXd> x(drops.data(), count), y(begins.data(), count);
  const double share = x.dot(y) / x.squaredNorm();
  const auto degrees_of_freedom = static_cast<double>(count - 1);
  const double deviation =
      std::sqrt((y - share * x).squaredNorm() / degrees_of_freedom / x.squaredNorm());
  const double p = kLagsTried * PValueOfStudent(share / deviation, degrees_of_freedom);
  return share > 0 && p < kLagByChance;
}

bool ShowsLag(const std::shared_ptr<const KeptRuns>& runs, const Eigen::VectorXd& torque,
              const Eigen::VectorXd& residual) {
  // at any of the time constants that a search would try
  return std::ranges::any_of(LagsOf(*runs).Tried(), [&](double lag) {
    return SeesLag(LaggedRows(runs, lag), torque, residual);
  });
}

}  // namespace warmjoint

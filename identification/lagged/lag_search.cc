#include "identification/lagged/lag_search.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>

namespace warmjoint {
namespace {

constexpr int kBits = 20;  // 1e-6
constexpr std::uintmax_t kMostFits = 40;

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

}  // namespace warmjoint

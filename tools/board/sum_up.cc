#include "tools/board/sum_up.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace warmjoint::inline tools {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// The sums of a parameter, added where they are not there yet: truths of a ladder may have other ones.
ParameterSums& SumsOf(std::vector<ParameterSums>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const ParameterSums& sums) { return sums.name == name; });
  if (found != all.end()) return *found;
  return all.emplace_back(ParameterSums{name, 0, 0, false, {}, {}});
}

void AddParameters(std::vector<ParameterSums>& all, const Score& score) {
  for (const ParameterScore& one : score.continuous) {
    // each parameter by its name
    ParameterSums& sums = SumsOf(all, one.name);
    sums.intervals += one.covered.has_value();
    sums.covered += one.covered.value_or(false);

    // errors only of what was estimated
    if (!one.estimated) continue;
    sums.estimated = true;
    sums.error.Add(one.estimate - one.truth);
    sums.bound.Add(one.bound);
  }
}

}  // namespace

int LeaderboardRow::failed() const {
  int count = 0;
  for (const auto& [status, runs_of_it] : failures) count += runs_of_it;
  return count;
}

void MeanSquare::Add(double value) {
  if (std::isnan(value)) return;
  sum_ += value * value;
  ++count_;
}

void MeanSquare::Add(const MeanSquare& other) {
  sum_ += other.sum_;
  count_ += other.count_;
}

double MeanSquare::Root() const { return std::sqrt(sum_ / static_cast<double>(count_)); }

IdentifierColumns::IdentifierColumns(const std::shared_ptr<NumberFile>& file)
    : npe_continuous_(file),
      npe_discrete_(file),
      rmse_(file),
      fit_(file),
      fpe_(file),
      mae_(file),
      seconds_(file),
      ranked_npe_(file) {}

void IdentifierColumns::Add(const Result& result) {
  if (result.status != "ok") {
    ++failures_[result.status];
    if (failure_example_.empty()) failure_example_ = result.message;
  }

  // a run without a figure counts as unknown, and for the rank as worse than any
  const auto metric = [&](double Metrics::*member) {
    return result.metrics ? (*result.metrics).*member : kUnknown;
  };
  rmse_.Add(metric(&Metrics::rmse));
  fit_.Add(metric(&Metrics::fit));
  fpe_.Add(metric(&Metrics::fpe));
  mae_.Add(metric(&Metrics::mae));
  seconds_.Add(result.seconds);
  npe_continuous_.Add(result.score ? result.score->npe_continuous : kUnknown);
  npe_discrete_.Add(result.score ? result.score->npe_discrete : kUnknown);
  ranked_npe_.Add(result.score ? result.score->npe_continuous : kInfinite);
  // errors of each parameter beside its bound
  if (result.score) AddParameters(parameters_, *result.score);
}

void IdentifierColumns::Add(const IdentifierColumns& other) {
  // all figures of the runs
  for (auto column :
       {&IdentifierColumns::npe_continuous_, &IdentifierColumns::npe_discrete_,
        &IdentifierColumns::rmse_, &IdentifierColumns::fit_, &IdentifierColumns::fpe_,
        &IdentifierColumns::mae_, &IdentifierColumns::seconds_, &IdentifierColumns::ranked_npe_}) {
    (this->*column).Add(other.*column);
  }
  // failures, with the first message of them
  for (const auto& [status, count] : other.failures_) failures_[status] += count;
  if (failure_example_.empty()) failure_example_ = other.failure_example_;
  // sums of each parameter, by its name
  for (const ParameterSums& more : other.parameters_) {
    ParameterSums& sums = SumsOf(parameters_, more.name);
    sums.intervals += more.intervals;
    sums.covered += more.covered;
    sums.estimated = sums.estimated || more.estimated;
    sums.error.Add(more.error);
    sums.bound.Add(more.bound);
  }
}

LeaderboardRow IdentifierColumns::SumUp(const SuiteIdentifier& identifier) const {
  LeaderboardRow row;
  row.identifier = identifier.label;
  row.claim = identifier.claim;
  row.runs = static_cast<int>(rmse_.size());
  row.failures = failures_;
  row.failure_example = failure_example_;

  // figures over the runs
  row.npe_continuous = Summarise(npe_continuous_);
  row.npe_discrete = Summarise(npe_discrete_);
  row.rmse = Summarise(rmse_);
  row.fit = Summarise(fit_);
  row.fpe = Summarise(fpe_);
  row.mae = Summarise(mae_);
  row.seconds = Summarise(seconds_);
  row.rank_npe = Summarise(ranked_npe_).median;

  // coverage of the intervals, and rms errors over the Cramer-Rao bound
  for (const ParameterSums& sums : parameters_) {
    ParameterRow parameter;
    parameter.name = sums.name;
    if (sums.intervals > 0) {
      parameter.coverage95 = static_cast<double>(sums.covered) / sums.intervals;
    }
    parameter.efficiency = sums.error.Root() / sums.bound.Root();
    row.parameters.push_back(parameter);
    if (!sums.estimated) row.not_estimated.push_back(sums.name);
  }
  return row;
}

}  // namespace warmjoint::inline tools

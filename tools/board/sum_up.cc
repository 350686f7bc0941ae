#include "tools/board/sum_up.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace warmjoint::inline tools {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

double RootMeanSquare(const std::vector<double>& values) { return Summarise(values).rms; }

/// Summary of one number of each result; the number is NaN where a result lacks it.
template <typename Number>
Summary SummariseEach(const Results& results, Number number) {
  std::vector<double> values;
  for (const Result* result : results) values.push_back(number(*result));
  return Summarise(std::move(values));
}

Summary SummariseMetric(const Results& results, double Metrics::*member) {
  return SummariseEach(results, [member](const Result& result) {
    return result.metrics ? (*result.metrics).*member : kUnknown;
  });
}

/// Continuous parameter i of every scored result.
std::vector<const ParameterScore*> Column(const Results& results, size_t i) {
  std::vector<const ParameterScore*> column;
  for (const Result* result : results) {
    if (result->score) column.push_back(&result->score->continuous.at(i));
  }
  return column;
}

ParameterRow SumUpParameter(const std::vector<const ParameterScore*>& column) {
  ParameterRow row;
  row.name = column.front()->name;
  int intervals = 0;
  int covered = 0;
  std::vector<double> errors, bounds;
  for (const ParameterScore* score : column) {
    if (score->covered) ++intervals;
    if (score->covered.value_or(false)) ++covered;
    if (!score->estimated) continue;
    errors.push_back(score->estimate - score->truth);
    bounds.push_back(score->bound);
  }
  if (intervals > 0) row.coverage95 = static_cast<double>(covered) / intervals;
  row.efficiency = RootMeanSquare(errors) / RootMeanSquare(bounds);
  return row;
}

void SumUpParameters(const Results& results, LeaderboardRow& row) {
  const auto scored = std::find_if(results.begin(), results.end(),
                                   [](const Result* result) { return result->score.has_value(); });
  if (scored == results.end()) return;
  for (size_t i = 0; i < (*scored)->score->continuous.size(); ++i) {
    const std::vector<const ParameterScore*> column = Column(results, i);
    row.parameters.push_back(SumUpParameter(column));
    const bool ever = std::any_of(column.begin(), column.end(),
                                  [](const ParameterScore* score) { return score->estimated; });
    if (!ever) row.not_estimated.push_back(column.front()->name);
  }
}

}  // namespace

int LeaderboardRow::failed() const {
  int count = 0;
  for (const auto& [status, runs_of_it] : failures) count += runs_of_it;
  return count;
}

Summary SummariseScore(const Results& results, double Score::*number) {
  return SummariseEach(results, [number](const Result& result) {
    return result.score ? (*result.score).*number : kUnknown;
  });
}

std::vector<double> RankedNpe(const Results& results) {
  std::vector<double> npe;
  for (const Result* result : results) {
    npe.push_back(result->score ? result->score->npe_continuous
                                : std::numeric_limits<double>::infinity());
  }
  return npe;
}

LeaderboardRow SumUp(const SuiteIdentifier& identifier, const Results& results) {
  LeaderboardRow row;
  row.identifier = identifier.label;
  row.claim = identifier.claim;
  row.runs = static_cast<int>(results.size());
  for (const Result* result : results) {
    if (result->status == "ok") continue;
    ++row.failures[result->status];
    if (row.failure_example.empty()) row.failure_example = result->message;
  }

  row.npe_continuous = SummariseScore(results, &Score::npe_continuous);
  row.npe_discrete = SummariseScore(results, &Score::npe_discrete);
  row.rmse = SummariseMetric(results, &Metrics::rmse);
  row.fit = SummariseMetric(results, &Metrics::fit);
  row.fpe = SummariseMetric(results, &Metrics::fpe);
  row.mae = SummariseMetric(results, &Metrics::mae);
  row.seconds = SummariseEach(results, [](const Result& result) { return result.seconds; });
  row.rank_npe = Summarise(RankedNpe(results)).median;
  SumUpParameters(results, row);
  return row;
}

}  // namespace warmjoint::inline tools

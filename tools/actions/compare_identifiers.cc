#include "tools/actions/compare_identifiers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "identification/answer/identify.h"
#include "identification/fit_data.h"
#include "identification/holdout/blocked_hold_out.h"
#include "identification/preparation/moving_view.h"
#include "identification/seen_samples.h"

namespace warmjoint::inline tools {
namespace {

/// The first sample of each block of times, and N. times: where the blocks but the first begin, s
std::vector<Eigen::Index> BoundsAt(const std::vector<double>& times, const Eigen::VectorXd& time) {
  std::vector<Eigen::Index> bounds{0};
  for (const double begin : times) bounds.push_back((time.array() < begin).count());
  bounds.push_back(time.size());
  return bounds;
}

/// Where the blocks but the first begin, s.
std::vector<double> BlockTimes(const PreparedLog& log) {
  const auto& [m, selection] = HoldsSpeeds(log) ? log.steady() : MovingView(log);
  std::vector<double> times;
  const std::vector<Eigen::Index> bounds = CutIntoBlocks(selection, kComparedBlocks);
  for (size_t i = 1; i + 1 < bounds.size(); ++i) times.push_back(m.time[bounds[i]]);
  return times;
}

/// Figures on blocks, into `one`.
void Figure(const IdentifierInput& input, const std::vector<Metrics>& blocks,
            ComparedIdentifier& one) {
  double squares = 0, samples = 0;
  // errors of all blocks, each by the number of its samples
  for (const Metrics& block : blocks) {
    one.blocks.push_back(block.rmse);
    squares += block.n * block.rmse * block.rmse;
    samples += block.n;
  }
  one.rmse = std::sqrt(squares / samples);
  // the fit is 100 % less the error as a share of the torque's deviation
  const Eigen::ArrayXd torque = Kept(input.measurements.torque, input.selection).array();
  const double spread = std::sqrt((torque - torque.mean()).square().mean());
  one.fit = 100 * (1 - *one.rmse / spread);
}

/// Paired differences to the best.
void TakeDifferences(std::vector<ComparedIdentifier>& compared) {
  // the identifier of the smallest error
  const ComparedIdentifier* best = nullptr;
  for (const ComparedIdentifier& one : compared) {
    if (one.rmse && (!best || *one.rmse < *best->rmse)) best = &one;
  }
  if (!best) return;
  const Eigen::Map<const Eigen::ArrayXd> least(best->blocks.data(),
                                               static_cast<Eigen::Index>(best->blocks.size()));
  // how much larger each other's is over the same blocks, with the standard error of that
  for (ComparedIdentifier& one : compared) {
    if (!one.rmse) continue;
    const Eigen::Map<const Eigen::ArrayXd> its(one.blocks.data(), least.size());
    const Eigen::ArrayXd more = its - least;
    const auto n = static_cast<double>(more.size());
    one.difference = more.mean();
    one.doubt = std::sqrt((more - more.mean()).square().sum() / (n * (n - 1)));
  }
}

}  // namespace

std::vector<ComparedIdentifier> CompareIdentifiers(const std::vector<IdentifyTask>& tasks,
                                                   const PreparedLog& log,
                                                   const Narrator& narrator) {
  const std::vector<double> times = BlockTimes(log);
  std::vector<ComparedIdentifier> compared;
  for (const IdentifyTask& task : tasks) {
    if (narrator) narrator(task.identifier.name);
    // fitted and judged as identify does it
    const IdentifierInput given{log, task.options, {}};
    const Estimate estimate = IdentifyAndJudge(task.identifier, given, task.judging);
    ComparedIdentifier& one = compared.emplace_back();
    one.name = task.identifier.name;
    one.status = estimate.status;
    one.message = estimate.FullMessage();
    // errors over blocks that are the same times for all
    const IdentifierInput input = Seen(task.identifier, given);
    const std::vector<Eigen::Index> bounds = BoundsAt(times, input.measurements.time);
    if (const auto blocks = BlockedFigures(task.identifier, input, bounds)) {
      Figure(input, *blocks, one);
    }
  }
  TakeDifferences(compared);
  return compared;
}

nlohmann::json ComparedToJson(const std::vector<ComparedIdentifier>& compared) {
  nlohmann::json rows = nlohmann::json::array();
  for (const ComparedIdentifier& one : compared) {
    nlohmann::json row{{"identifier", one.name},
                       {"status", StatusName(one.status)},
                       {"message", one.message},
                       {"blocks", one.blocks}};
    // an identifier without figures has none of these
    for (const char* key : {"rmse", "fit", "difference", "difference_std"}) row[key] = nullptr;
    if (one.rmse) {
      row["rmse"] = *one.rmse;
      row["fit"] = one.fit;
      row["difference"] = one.difference;
      row["difference_std"] = one.doubt;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace warmjoint::inline tools

// `compare --format json`.
#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/leaderboard/format_board.h"

namespace warmjoint {
namespace {

using nlohmann::ordered_json;

ordered_json Number(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json Quantiles(const Summary& summary) {
  return {{"median", Number(summary.median)},
          {"q25", Number(summary.q25)},
          {"q75", Number(summary.q75)}};
}

ordered_json QuantilesAndRms(const Summary& summary) {
  ordered_json json = Quantiles(summary);
  json["rms"] = Number(summary.rms);
  return json;
}

ordered_json ClaimJson(const Claim& claim) {
  ordered_json json{{"source", claim.source}};
  if (claim.npe_continuous) json["npe_continuous"] = *claim.npe_continuous;
  if (claim.rmse) json["rmse"] = *claim.rmse;
  return json;
}

ordered_json RowJson(const LeaderboardRow& row) {
  ordered_json json{{"identifier", row.identifier},
                    {"runs", row.runs},
                    {"failures", ordered_json::object()},
                    {"npe",
                     {{"continuous", QuantilesAndRms(row.npe_continuous)},
                      {"discrete", QuantilesAndRms(row.npe_discrete)}}},
                    {"rmse", Quantiles(row.rmse)},
                    {"fit", Quantiles(row.fit)},
                    {"fpe", Quantiles(row.fpe)},
                    {"mae", Quantiles(row.mae)},
                    {"coverage95", ordered_json::object()},
                    {"efficiency", ordered_json::object()},
                    {"seconds", {{"median", Number(row.seconds.median)}}},
                    {"not_estimated", row.not_estimated}};
  for (const auto& [status, count] : row.failures) json["failures"][status] = count;
  for (const ParameterRow& parameter : row.parameters) {
    if (parameter.coverage95) json["coverage95"][parameter.name] = *parameter.coverage95;
    if (std::isfinite(parameter.efficiency)) {
      json["efficiency"][parameter.name] = parameter.efficiency;
    }
  }
  if (row.claim) json["claim"] = ClaimJson(*row.claim);
  return json;
}

}  // namespace

std::string BoardToJson(const Leaderboard& board) {
  ordered_json json{{"suite", board.suite},
                    {"question", board.question},
                    {"realizations", board.finished},
                    {"bound_npe",
                     {{"continuous", {{"rms", Number(board.bound_npe_continuous)}}},
                      {"discrete", {{"rms", Number(board.bound_npe_discrete)}}}}},
                    {"rows", ordered_json::array()}};
  for (const LeaderboardRow& row : board.rows) json["rows"].push_back(RowJson(row));
  return json.dump(2) + "\n";
}

}  // namespace warmjoint

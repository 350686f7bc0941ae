// `compare --format json`.
#include <cmath>
#include <nlohmann/json.hpp>

#include "models/foundation/number_json.h"
#include "tools/board/format_board.h"

namespace warmjoint {
namespace {

using nlohmann::ordered_json;

ordered_json Quantiles(const Summary& summary) {
  return {{"median", NumberOrNull(summary.median)},
          {"q25", NumberOrNull(summary.q25)},
          {"q75", NumberOrNull(summary.q75)}};
}

ordered_json QuantilesAndRms(const Summary& summary) {
  ordered_json json = Quantiles(summary);
  json["rms"] = NumberOrNull(summary.rms);
  return json;
}

ordered_json ClaimJson(const Claim& claim) {
  ordered_json json{{"source", claim.source}};
  for (const auto& [name, value] : claim.figures) json[name] = value;
  return json;
}

ordered_json RowJson(const LeaderboardRow& row) {
  // figures as quantiles over the runs, times as a median alone
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
                    {"seconds", {{"median", NumberOrNull(row.seconds.median)}}},
                    {"not_estimated", row.not_estimated}};
  for (const auto& [status, count] : row.failures) json["failures"][status] = count;
  // intervals and errors of each parameter
  for (const ParameterRow& parameter : row.parameters) {
    if (parameter.coverage95) json["coverage95"][parameter.name] = *parameter.coverage95;
    if (std::isfinite(parameter.efficiency)) {
      json["efficiency"][parameter.name] = parameter.efficiency;
    }
  }
  // how far behind the best one, and whether that is a tie
  if (row.behind) {
    json["behind_best"] = {{"median", NumberOrNull(row.behind->median)},
                           {"interval95", ordered_json::array({NumberOrNull(row.behind->lower),
                                                               NumberOrNull(row.behind->upper)})},
                           {"tie", row.behind->tie()}};
  }
  if (row.claim) json["claim"] = ClaimJson(*row.claim);
  return json;
}

/// Board or group without its head.
void AddNumbers(ordered_json& json, const Leaderboard& board) {
  // how many, how well it could be done, and how well it was done
  json["realizations"] = board.finished;
  json["bound_npe"] = {{"continuous", {{"rms", NumberOrNull(board.bound_npe_continuous)}}},
                       {"discrete", {{"rms", NumberOrNull(board.bound_npe_discrete)}}}};
  json["rows"] = ordered_json::array();
  for (const LeaderboardRow& row : board.rows) json["rows"].push_back(RowJson(row));
}

ordered_json GroupJson(const Leaderboard& group) {
  ordered_json json{{"variant", group.variant}};
  json["value"] = group.value ? NumberOrNull(*group.value) : nlohmann::json(nullptr);
  AddNumbers(json, group);
  return json;
}

ordered_json BoardJson(const Leaderboard& board) {
  ordered_json json{{"suite", board.suite}, {"question", board.question}};
  AddNumbers(json, board);
  if (!board.groups.empty()) json["variable"] = board.variable;
  for (const Leaderboard& group : board.groups) json["groups"].push_back(GroupJson(group));
  return json;
}

}  // namespace

std::string BoardToJson(const Leaderboard& board) { return BoardJson(board).dump(2) + "\n"; }

std::string BoardsToJson(const std::vector<NamedBoard>& boards) {
  ordered_json json{{"runs", ordered_json::array()}};
  for (const NamedBoard& named : boards) {
    ordered_json run{{"run", named.run}};
    run.update(BoardJson(named.board));
    json["runs"].push_back(run);
  }
  return json.dump(2) + "\n";
}

}  // namespace warmjoint

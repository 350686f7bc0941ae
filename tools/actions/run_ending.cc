#include "tools/actions/run_ending.h"

#include <fmt/format.h>

#include <set>

#include "tools/store/database.h"

namespace warmjoint {
namespace {

/// What an identifier said first.
std::string FirstWords(const RunStore& store, int identifier) {
  return Guarded(store.results_file(), [&] {
    SQLite::Statement first(store.database(),
                            "SELECT status || ': ' || message FROM result WHERE identifier = ? "
                            "ORDER BY variant, realization LIMIT 1");
    first.bind(1, identifier);
    return first.executeStep() ? first.getColumn(0).getString() : "";
  });
}

}  // namespace

RunEnding EndingOf(const RunStore& store) {
  static const std::set<std::string> unanswered{"crashed", "timeout", "bad_answer"};
  RunEnding ending;
  std::set<int> all, answered;
  for (const StatusCount& count : store.CountStatuses()) {
    // no answer, no log to answer on, or an answer that the tests refuse
    const bool silent = unanswered.contains(count.status);
    const bool absent = count.status == "not_simulated";
    ending.results += count.results;
    if (silent) ending.unanswered += count.results;
    if (absent) ending.not_simulated += count.results;
    if (!silent && !absent && count.status != "ok") ending.refused += count.results;
    // a refusal is an answer, silence is none
    all.insert(count.identifier);
    if (!silent && !absent) answered.insert(count.identifier);
  }

  // identifiers that never answered, each with its first reason
  for (std::size_t i = 0; i < store.suite().identifiers.size(); ++i) {
    const auto identifier = static_cast<int>(i);
    if (!all.contains(identifier) || answered.contains(identifier)) continue;
    ending.silent.emplace_back(store.suite().identifiers[i].label, FirstWords(store, identifier));
  }
  return ending;
}

std::string CountsInWords(const RunEnding& ending) {
  std::string words = fmt::format("{} results", ending.results);
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) words += fmt::format(", {} {}", count, what);
  };
  add(ending.refused, "refused by their own verdict");
  add(ending.unanswered, "without an answer");
  add(ending.not_simulated, "not simulated");
  return words;
}

}  // namespace warmjoint

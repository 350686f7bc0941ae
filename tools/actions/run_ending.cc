#include "tools/actions/run_ending.h"

#include <fmt/format.h>

#include <map>
#include <set>

namespace warmjoint::inline tools {

RunEnding EndingOf(const RunStore& store) {
  static const std::set<std::string> unanswered{"crashed", "timeout", "bad_answer"};
  RunEnding ending;

  // by position of the identifier: who answered, and the first reason of each not to
  std::set<int> answered;
  std::map<int, std::string> first;
  store.ForEachUnit([&](const std::vector<Result>& unit) {
    for (const Result& result : unit) {
      ++ending.results;
      // no answer, no log to answer on, or an answer that the tests refuse
      const bool silent = unanswered.contains(result.status);
      const bool absent = result.status == "not_simulated";
      ending.unanswered += silent;
      ending.not_simulated += absent;
      ending.refused += !silent && !absent && result.status != "ok";
      // a refusal is an answer, silence is none
      if (silent || absent) {
        first.emplace(result.identifier, result.status + ": " + result.message);
      } else {
        answered.insert(result.identifier);
      }
    }
  });

  const std::vector<std::string> labels = store.ReadDescription().identifiers;
  // identifiers that never answered, each with its first reason
  for (const auto& [identifier, reason] : first) {
    if (answered.contains(identifier)) continue;
    ending.silent.emplace_back(labels[static_cast<std::size_t>(identifier)], reason);
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

}  // namespace warmjoint::inline tools

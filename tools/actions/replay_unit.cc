#include "tools/actions/replay_unit.h"

#include <fmt/format.h>
#include <warmjoint/prepared_log.h>

#include "sim/plant/plant.h"
#include "tools/suite/prepare_identifiers.h"
#include "tools/suite/run_realization.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint {

Replayed ReplayUnit(const Suite& suite, RunUnit unit, const SuiteIdentifier& identifier) {
  if (identifier.name == kExternal) {
    Refuse({identifier.label}, "is a command from outside; a replay runs none");
  }
  const Scenario scenario = VariantScenario(suite, unit.variant);
  const auto realization = static_cast<std::uint64_t>(unit.realization);
  PreparedLog log = Prepare(MakePlant(scenario)->Run(realization).measurements);
  const auto identify = PrepareIdentifiers({identifier}, {suite.name});
  Estimate estimate = identify.front()(log, StartKeyOf(scenario.seed, realization));
  return {std::move(log), std::move(estimate)};
}

std::string NameOf(const Suite& suite, RunUnit unit) {
  std::string name = fmt::format("realization {}", unit.realization);
  if (!suite.ladder) return name;
  const auto& variants = suite.ladder->variants;
  return fmt::format("{} of {}", name, variants.at(static_cast<std::size_t>(unit.variant)).name);
}

std::string ReplayCommand(const Suite& suite, RunUnit unit, const std::string& run) {
  std::vector<std::string> words{"warmjoint", "simulate", "--from", run};
  if (suite.ladder) {
    const auto& variants = suite.ladder->variants;
    words.insert(words.end(),
                 {"--variant", variants.at(static_cast<std::size_t>(unit.variant)).name});
  }
  words.insert(words.end(), {"--realization", fmt::format("{}", unit.realization), "-o", "replay"});
  return JoinCommand(words);
}

}  // namespace warmjoint

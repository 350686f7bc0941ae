#include "tools/cli/identify_several.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "identification/identifiers/identifier_list.h"
#include "identification/linear/rigid_part.h"
#include "models/foundation/excerpt.h"
#include "tools/actions/compare_identifiers.h"
#include "tools/terminal/progress_line.h"
#include "tools/terminal/say.h"
#include "tools/terminal/table.h"

namespace warmjoint::inline tools {
namespace {

/// The settings of one of several identifiers: options that it does not have are for the others.
IdentifySettings SettingsOfOne(const IdentifyArguments& arguments, const std::string& name) {
  // an option that no identifier knows stays, so that it is refused
  IdentifySettings settings = SettingsOf(arguments, name);
  const Identifier& identifier = FindIdentifier(name);
  std::erase_if(settings.options, [&](const auto& option) {
    const bool known = std::ranges::any_of(arguments.identifiers, [&](const std::string& other) {
      return FindIdentifier(other).Has(option.first);
    });
    return known && !identifier.Has(option.first);
  });
  // gravity is for those that can tell it from friction
  if (!TellsGravity(identifier)) settings.gravity = "none";
  return settings;
}

/// A table of several identifiers.
std::string ComparedToText(const std::vector<ComparedIdentifier>& compared,
                           const std::string& unit) {
  Table table{{"identifier", "verdict", fmt::format("held-out RMSE {}", unit), "Fit %",
               fmt::format("above the best {}", unit)},
              {}};
  for (const ComparedIdentifier& one : compared) {
    // an identifier without an answer has no error
    std::vector<std::string> row{one.name, std::string(StatusName(one.status)), "-", "-", "-"};
    if (one.rmse) {
      row[2] = fmt::format("{:.4g}", *one.rmse);
      row[3] = fmt::format("{:.2f}", one.fit);
      row[4] = fmt::format("{:.2g} +- {:.2g}", one.difference, one.doubt);
    }
    table.rows.push_back(std::move(row));
  }
  return fmt::format(
      "{} blocks of time, each held out from a fit to the others; differences are "
      "paired over the blocks, with their standard error\n\n{}",
      kComparedBlocks, TableToText(table, 2));
}

}  // namespace

ExitStatus IdentifySeveral(const IdentifyArguments& arguments) {
  // what tells of one estimate
  for (const auto& [option, value] :
       {std::pair{"--output", &arguments.output}, std::pair{"--mjcf", &arguments.mjcf},
        std::pair{"--plot", &arguments.plot}, std::pair{"--follows", &arguments.follow.file}}) {
    if (value->empty()) continue;
    Refuse({option}, "is for one identifier, and {} are given", arguments.identifiers.size());
  }

  // everything that can be refused is, before any time is spent
  std::vector<IdentifyTask> tasks;
  for (const std::string& identifier : arguments.identifiers) {
    if (identifier.find('=') != std::string::npos) {
      Refuse({"--identifier"}, "'{}' is a command, and commands are tried alone; leave the others",
             Excerpt(identifier));
    }
    tasks.push_back(
        CheckSettings(SettingsOfOne(arguments, identifier), JointOf(arguments.recording)));
  }

  // the same blocks for all
  Activity activity("reading the recording");
  const PreparedLog log = ReadAndPrepare(arguments.recording);
  const auto compared = CompareIdentifiers(
      tasks, log, [&](const std::string& words) { activity.Is("comparing: " + words); });
  activity.Aside([&] {
    if (arguments.format == "json") {
      fmt::print("{}\n", ComparedToJson(compared).dump(2));
    } else {
      Say(stdout, "{}", ComparedToText(compared, log.taken().measurements.torque_unit));
    }
  });

  // one answer that can be trusted is enough
  const bool any_ok = std::ranges::any_of(
      compared, [](const ComparedIdentifier& one) { return one.status == Status::ok; });
  return any_ok ? ExitStatus::done : ExitStatus::nothing_trustworthy;
}

}  // namespace warmjoint::inline tools

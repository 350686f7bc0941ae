// A suite: one scenario, many realizations, several identifiers or compensators, one question.
#pragma once

#include <warmjoint/claim.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/scenario.h"

namespace warmjoint {

/// Name under which a suite holds an identifier that is a command of its own; the command is the
/// option of that name. An entry {name: mine, command: ...} is the same with the label mine.
inline constexpr const char* kExternal = "external";

/// Who answers: identifiers with an estimate, or compensators with a torque along the log.
enum class Contest { identifiers, compensators };

/// The compensator that knows the true friction: a measure for the others, as the bound is for identifiers.
inline constexpr const char* kTruthCompensator = "truth";

/// An identifier or a compensator as a suite runs it.
struct SuiteIdentifier {
  std::string name;
  std::string label;
  std::map<std::string, std::string> options;
  std::optional<Claim> claim;

  template <class A>
  void Serialize(A* a) {
    a->Field("name", &name,
             {.meaning = "one of `warmjoint list identifiers`, or of `list compensators`",
              .needed = "name an identifier (`list identifiers`)"});
    if (label.empty()) label = name;
    a->Field("label", &label, {.meaning = "its row of the leaderboard; the name where not given"});
    a->Field("options", &options, LeftOut("as `--set` of `identify`"));
    a->Field("claim", &claim, {.meaning = "what others claim, printed with what was reached"});
    // a command of the user's stands in the place of an identifier of the list
    std::string command;
    a->Field("command", &command,
             LeftOut("an identifier of your own under that name, carried out with `run "
                     "--allow-commands` alone; files stand relative to the suite"));
    a->Check(command.empty() || !options.contains("command"), "command",
             "absent: it stands in options too");
    if (command.empty()) return;
    name = kExternal;
    options["command"] = command;
  }

  bool operator==(const SuiteIdentifier&) const = default;
};

/// One rung of a suite's ladder: the scenario with some entries changed.
struct Variant {
  std::string name;             // group of the leaderboard
  std::optional<double> value;  // of the ladder's variable, where it has one
  Settings settings;            // applied to the suite's scenario
};

/// Groups of one suite. Every group runs all realizations and identifiers. Realization r of every
/// group has the same random numbers, so that groups compare in pairs.
struct Ladder {
  std::string variable;  // what the rungs climb, for example noise.torque; empty: named variants
  std::string unit;      // of the variable, for tables and axes
  std::vector<Variant> variants;
};
void ReadValue(const Node& node, Ladder* value, const FieldInfo& info);
Tree WriteValue(const Ladder& value);

/// The scenario of a suite, which has no name and seed of its own.
struct SuiteScenario {
  Scenario scenario;
};
void ReadValue(const Node& node, SuiteScenario* value, const FieldInfo& info);
Tree WriteValue(const SuiteScenario& value);

/// Most realizations of a variant: their list takes 80 MB.
inline constexpr int kMostRealizations = 10'000'000;

struct Suite {
  std::string name;
  std::string question;
  int realizations = 1;
  Scenario scenario;                         // its seed is the suite's
  std::vector<SuiteIdentifier> identifiers;  // who answers, of either kind
  Contest contest = Contest::identifiers;
  std::optional<Ladder> ladder;

  /// Number of groups: that of the ladder's variants, 1 without a ladder.
  int variants() const { return ladder ? static_cast<int>(ladder->variants.size()) : 1; }

  template <class A>
  void Serialize(A* a) {
    a->Field("name", &name, {.meaning = "for tables and titles; the file's name where not given"});
    a->Field("question", &question,
             {.meaning = "what the suite asks, one sentence",
              .needed = "say in a sentence what the suite asks"});
    a->Field("realizations", &realizations,
             WithDefault("", "of each rung of the ladder",
                         {.at_least = 1, .at_most = kMostRealizations}));
    // one seed and one name for all of it
    std::uint64_t seed = scenario.seed;
    a->Field("seed", &seed, {.meaning = "of all random numbers"});
    SuiteScenario realized{scenario};
    a->Field("scenario", &realized,
             {.meaning = "a scenario without `name` and `seed`",
              .needed = "give the scenario to realize"});
    scenario = realized.scenario;
    scenario.name = name;
    scenario.seed = seed;
    // what varies, and who answers
    a->Field("ladder", &ladder, {.meaning = "what varies from group to group of the leaderboard"});
    // who answers: one kind alone, since errors of parameters and residuals do not compare
    std::vector<SuiteIdentifier> identify, compensate;
    (contest == Contest::identifiers ? identify : compensate) = identifiers;
    a->Field("identifiers", &identify, LeftOut("who answers, or `compensators`"));
    a->Field("compensators", &compensate,
             LeftOut("who answers with a torque along the log, against the true friction"));
    a->Check(identify.empty() != compensate.empty(), "identifiers",
             "one that has `identifiers` or `compensators`, a list of one at least, not both");
    contest = compensate.empty() ? Contest::identifiers : Contest::compensators;
    identifiers = compensate.empty() ? identify : compensate;
  }
};

/// The scenario of one group, with the suite's seed. variant: from 0. Without a ladder it is the
/// suite's own scenario.
Scenario VariantScenario(const Suite& suite, int variant);

/// Reads a suite file (scenarios/keys.md). Throws BadInput as ReadScenario does; every variant is checked.
Suite ReadSuite(const std::string& path);

/// The same of a text; file: what refusals name, and where relative paths start.
Suite ParseSuite(const std::string& text, const std::string& file);

/// The whole suite, defaults written out; ReadSuite of it gives the same suite.
std::string SuiteToYaml(const Suite& suite);

}  // namespace warmjoint

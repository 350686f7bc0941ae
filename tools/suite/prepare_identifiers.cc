#include "tools/suite/prepare_identifiers.h"

#include <algorithm>

#include "identification/identifiers/identifier_list.h"
#include "models/foundation/excerpt.h"
#include "tools/identify/identify_recording.h"
#include "tools/suite/external_identifier.h"

namespace warmjoint {
namespace {

bool Contains(const std::vector<SuiteIdentifier>& identifiers, const std::string& label) {
  return std::any_of(identifiers.begin(), identifiers.end(),
                     [&](const SuiteIdentifier& one) { return one.label == label; });
}

/// Adds what one name stands for.
void Add(const std::string& name, const std::vector<SuiteIdentifier>& suite, Contest contest,
         std::vector<SuiteIdentifier>& chosen) {
  // a command from outside brings its own name
  const bool compensates = contest == Contest::compensators;
  if (name.find('=') != std::string::npos) {
    if (compensates) {
      Refuse(
          {"--identifier"},
          "'{}' is a command, and this suite compares compensators; name some of `warmjoint list "
          "compensators`",
          Excerpt(name));
    }
    const SuiteIdentifier external = ReadExternal(name);
    if (Contains(chosen, external.label)) {
      Refuse({"--identifier"}, "there is a '{}' already; give yours another name",
             Excerpt(external.label));
    }
    chosen.push_back(external);
    return;
  }
  // a name may stand for several identifiers of the suite
  const std::string current = CurrentName(name);
  bool in_suite = false;
  for (const SuiteIdentifier& one : suite) {
    if (one.label != name && CurrentName(one.name) != current) continue;
    in_suite = true;
    if (!Contains(chosen, one.label)) chosen.push_back(one);
  }
  // any other is one of the list, with its usual options
  if (!in_suite && !Contains(chosen, name)) {
    const std::string known = compensates ? FindCompensator(name).name : FindIdentifier(name).name;
    chosen.push_back({known, name, {}, {}});
  }
}

}  // namespace

std::vector<SuiteIdentifier> ChooseIdentifiers(const std::vector<SuiteIdentifier>& suite,
                                               const std::vector<std::string>& names,
                                               Contest contest) {
  const auto adds = [](const std::string& name) { return name.starts_with('+'); };
  std::vector<SuiteIdentifier> chosen;
  if (std::all_of(names.begin(), names.end(), adds)) chosen = suite;
  for (const std::string& name : names) {
    Add(adds(name) ? name.substr(1) : name, suite, contest, chosen);
  }
  return chosen;
}

std::vector<PreparedIdentifier> PrepareIdentifiers(
    const std::vector<SuiteIdentifier>& identifiers, const Place& place, Confinement confinement,
    const std::map<std::string, AnswerFunction>& functions) {
  std::vector<PreparedIdentifier> prepared;
  for (const SuiteIdentifier& one : identifiers) {
    if (const auto own = functions.find(one.label); own != functions.end()) {
      prepared.push_back(PrepareFunction(one.label, own->second));
      continue;
    }
    // a command from outside has its own way to answer
    if (one.name == kExternal) {
      prepared.push_back(PrepareExternal(one, place, {}, confinement));
      continue;
    }
    // options are checked before anything runs
    const Identifier& identifier = FindIdentifier(one.name);
    const IdentifyTask task{identifier, identifier.options.Read(one.options, place)};
    prepared.emplace_back([task](const PreparedLog& log, StartKey start) {
      return Identify(task, log, {.start = start}).estimate;
    });
  }
  return prepared;
}

Contestants PrepareContestants(const Suite& suite, const Place& place, Confinement confinement,
                               const std::map<std::string, AnswerFunction>& functions) {
  if (suite.contest == Contest::identifiers) {
    return PrepareIdentifiers(suite.identifiers, place, confinement, functions);
  }
  Contestants contestants;
  for (const SuiteIdentifier& one : suite.identifiers) {
    CompensatorArm arm = FindCompensator(one.name);
    arm.options = arm.options.Read(one.options, place);
    contestants.compensators.push_back({one.label, std::move(arm)});
  }
  return contestants;
}

}  // namespace warmjoint

#include "tools/suite/prepare_identifiers.h"

#include "identification/answer/identify.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/read_options.h"
#include "tools/suite/external_identifier.h"

namespace warmjoint::inline tools {

std::vector<PreparedIdentifier> PrepareIdentifiers(const std::vector<SuiteIdentifier>& identifiers,
                                                   const Place& place) {
  std::vector<PreparedIdentifier> prepared;
  for (const SuiteIdentifier& one : identifiers) {
    // a command from outside has its own way to answer
    if (one.name == kExternal) {
      prepared.push_back(PrepareExternal(one, place));
      continue;
    }
    // options are checked before anything runs
    const Identifier& identifier = FindIdentifier(one.name);
    const Options options = ReadOptions(identifier.options, one.options, place);
    prepared.emplace_back([identifier, options](const PreparedLog& log, StartKey start) {
      return IdentifyAndJudge(identifier, {log, options, start});
    });
  }
  return prepared;
}

}  // namespace warmjoint::inline tools

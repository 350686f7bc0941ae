#include "tools/run/prepared_identifier.h"

#include "identification/identifier.h"
#include "tools/run/external_identifier.h"

namespace warmjoint {

std::vector<PreparedIdentifier> PrepareIdentifiers(const std::vector<SuiteIdentifier>& identifiers,
                                                   const Place& place) {
  std::vector<PreparedIdentifier> prepared;
  for (const SuiteIdentifier& one : identifiers) {
    if (one.name == kExternal) {
      prepared.push_back(PrepareExternal(one, place));
      continue;
    }
    const Identifier& identifier = FindIdentifier(one.name);
    const Options options(identifier.options, one.options, place);
    prepared.emplace_back(
        [identify = identifier.identify, options](const Measurements& measurements,
                                                  const Selection& selection, RandomKey random) {
          return identify({measurements, selection, options, random});
        });
  }
  return prepared;
}

}  // namespace warmjoint

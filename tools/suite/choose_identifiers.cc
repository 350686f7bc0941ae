#include "tools/suite/choose_identifiers.h"

#include <algorithm>

#include "identification/identifiers/identifier_list.h"

namespace warmjoint::inline tools {
namespace {

bool Contains(const std::vector<SuiteIdentifier>& identifiers, const std::string& label) {
  return std::any_of(identifiers.begin(), identifiers.end(),
                     [&](const SuiteIdentifier& one) { return one.label == label; });
}

}  // namespace

std::vector<SuiteIdentifier> ChooseIdentifiers(const std::vector<SuiteIdentifier>& suite,
                                               const std::vector<std::string>& names,
                                               CommandForm form) {
  if (names.empty()) return suite;
  std::vector<SuiteIdentifier> chosen;
  for (const std::string& name : names) {
    if (IsExternal(name)) {
      chosen.push_back(ReadExternal(name, form));
      continue;
    }
    bool in_suite = false;
    for (const SuiteIdentifier& one : suite) {
      if (one.label != name && one.name != name) continue;
      in_suite = true;
      if (!Contains(chosen, one.label)) chosen.push_back(one);
    }
    if (!in_suite && !Contains(chosen, name)) {
      chosen.push_back({FindIdentifier(name).name, name, {}, {}});
    }
  }
  return chosen;
}

}  // namespace warmjoint::inline tools

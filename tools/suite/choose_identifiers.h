// Which identifiers a run takes.
#pragma once

#include <string>
#include <vector>

#include "scenarios/suite_identifier.h"
#include "tools/suite/external_identifier.h"

namespace warmjoint::inline tools {

/// The suite's identifiers whose label or name is among `names`, in the order of `names`; all of them
/// where each name begins with '+' or there is none. +NAME adds to them. A name that the suite lacks is
/// taken from the list of identifiers with its default options; name=command becomes an external
/// one, its command read as `form` says. Throws BadInput for a name that neither has, and for a
/// command under a label that is taken.
std::vector<SuiteIdentifier> ChooseIdentifiers(const std::vector<SuiteIdentifier>& suite,
                                               const std::vector<std::string>& names,
                                               CommandForm form);

}  // namespace warmjoint::inline tools

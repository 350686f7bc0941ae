// What a run is, in words for those who never saw warmjoint.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scenarios/suite.h"

namespace warmjoint::figures {

/// What each realization of the suite is, one sentence each: plant, friction, motion, log, variants.
std::vector<std::string> WhatWasSimulated(const Suite& suite);

/// What an entry of the suite is: of the list of identifiers, with its options, or a command from outside.
std::string WhatItIs(const SuiteIdentifier& identifier);

/// Terms of a run's page with their meaning.
const std::vector<std::pair<std::string, std::string>>& RunTerms();

}  // namespace warmjoint::figures

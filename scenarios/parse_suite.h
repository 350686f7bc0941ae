// Suites from texts, and their bounds.
#pragma once

#include <string>

#include "scenarios/suite.h"

namespace warmjoint::inline scenarios {

/// Most realizations of a variant: their list takes 80 MB.
inline constexpr int kMostRealizations = 10'000'000;

/// As ReadSuite (suite.h) from a text; file: what refusals name, and where relative paths start.
Suite ParseSuite(const std::string& text, const std::string& file);

}  // namespace warmjoint::inline scenarios

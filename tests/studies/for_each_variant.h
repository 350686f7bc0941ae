// What the studies of suites share: their command line.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>

#include "models/foundation/bad_input.h"
#include "models/foundation/parse_number.h"
#include "scenarios/suite.h"

namespace warmjoint {

/// NAME SUITE.yaml [REALIZATIONS [VARIANT...]]: calls study(suite, variant, realizations) for each variant that is
/// asked for, all where none is. Returns the exit status.
inline int StudyVariants(const char* name, int count, char** arguments,
                         const std::function<void(const Suite&, int, int)>& study) {
  if (count < 2) {
    fmt::print(stderr, "{} SUITE.yaml [REALIZATIONS [VARIANT...]]\n", name);
    return 2;
  }
  try {
    const Suite suite = ReadSuite(arguments[1]);
    const std::optional<double> given = count > 2 ? ParseNumber(arguments[2]) : std::nullopt;
    const int realizations = given ? static_cast<int>(*given) : suite.realizations;
    for (int variant = 0; variant < suite.variants(); ++variant) {
      const bool wanted =
          count < 4 ||
          (suite.ladder && std::find(arguments + 3, arguments + count,
                                     suite.ladder->variants[static_cast<size_t>(variant)].name) !=
                               arguments + count);
      if (wanted) study(suite, variant, realizations);
    }
  } catch (const BadInput& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}

}  // namespace warmjoint

// Fits of identifiers to one log of Table I, for tests of what they are made of.
#pragma once

#include <warmjoint/prepared_log.h>

#include <map>
#include <string>

#include "identification/identifier.h"
#include "tests/support/warm_recording.h"

namespace warmjoint::test {

/// Twenty minutes of Table I at 1 Hz, noise 0.5 N.m. given: options by name
inline Fit FitOfTableOne(const Identifier& identifier,
                         const std::map<std::string, std::string>& given) {
  const Measurements m = RecordFriction(TableOne(), 1, AlternatingSpeeds(1200, 3), 0.5, 3);
  return identifier.fit({Prepare(m), identifier.options.Read(given), {}});
}

}  // namespace warmjoint::test

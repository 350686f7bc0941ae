// From a recording to the log that every identifier gets.
#pragma once

#include "identification/preparation/prepared_log.h"
#include "identification/preparation/select.h"

namespace warmjoint::inline identification {

/// Prepares a log: the samples at constant speed are found in it (select.h). The one path of command
/// line, suites, tests of verdicts and benchmarks. Throws BadInput where there is no velocity and the
/// slope of the positions is no number.
PreparedLog Prepare(Measurements measurements, const PrepareSettings& holds = {});

/// The same where a plant says which samples move at constant speed.
PreparedLog Prepare(Measurements measurements, Selection known);

}  // namespace warmjoint::inline identification

// What helps against each lack of fit: the law, identifier or recording to try.
#pragma once

#include <string>

#include "identification/lack_of_fit/table.h"

namespace warmjoint {

/// What to do where a start that was taken to be cold may have been warm.
std::string RemedyForWarmStart(const Identifier& identifier);

std::string RemedyForWarming(const Advice& advice);
std::string RemedyForStart(const Advice& advice);
std::string RemedyForSpeed(const Advice& advice);
std::string RemedyForWarmingSlope(const Advice& advice);
std::string RemedyForDirection(const Advice& advice);
std::string RemedyForLoad(const Advice& advice);
std::string RemedyForTemperature(const Advice& advice);
std::string RemedyForStep(const Advice& advice);
std::string RemedyForMemory(const Advice& advice);
std::string RemedyForHolds(const Advice& advice);
std::string RemedyForPeriod(const Advice& advice);
std::string RemedyForLag(const Advice& advice);
std::string RemedyForFading(const Advice& advice);
std::string RemedyForPosition(const Advice& advice);
std::string RemedyForMotorAngle(const Advice& advice);
std::string RemedyForAngleBySpeed(const Advice& advice);

}  // namespace warmjoint

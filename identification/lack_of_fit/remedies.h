// What helps against each lack of fit: the law, identifier or recording to try.
#pragma once

#include <string>

#include "identification/lack_of_fit/table.h"

namespace warmjoint {

std::string AgainstWarming(const Advice& advice);
std::string AgainstStart(const Advice& advice);
std::string AgainstSpeed(const Advice& advice);
std::string AgainstWarmingSlope(const Advice& advice);
std::string AgainstDirection(const Advice& advice);
std::string AgainstLoad(const Advice& advice);
std::string AgainstTemperature(const Advice& advice);
std::string AgainstStep(const Advice& advice);
std::string AgainstMemory(const Advice& advice);
std::string AgainstHolds(const Advice& advice);
std::string AgainstPeriod(const Advice& advice);
std::string AgainstLag(const Advice& advice);
std::string AgainstFading(const Advice& advice);
std::string AgainstPosition(const Advice& advice);
std::string AgainstMotorAngle(const Advice& advice);

}  // namespace warmjoint

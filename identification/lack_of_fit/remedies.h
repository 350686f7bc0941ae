// What helps against each lack of fit: the law, identifier or recording to try.
#pragma once

#include <string>

#include "identification/command.h"
#include "identification/lack_of_fit/table.h"

namespace warmjoint {

/// What to do where a start that was taken to be cold may have been warm.
std::string RemedyForWarmStart(const Identifier& identifier);

/// The remedy, or words where it tries what the fit has done already.
Remedy WithoutWhatWasDone(const Advice& advice, Remedy remedy);

Remedy RemedyForWarming(const Advice& advice);
Remedy RemedyForStart(const Advice& advice);
Remedy RemedyForSpeed(const Advice& advice);
Remedy RemedyForWarmingSlope(const Advice& advice);
Remedy RemedyForGravity(const Advice& advice);
Remedy RemedyForRecording(const Advice& advice);
Remedy RemedyForDirection(const Advice& advice);
Remedy RemedyForLoad(const Advice& advice);
Remedy RemedyForTemperature(const Advice& advice);
Remedy RemedyForStep(const Advice& advice);
Remedy RemedyForMemory(const Advice& advice);
Remedy RemedyForHolds(const Advice& advice);
Remedy RemedyForPeriod(const Advice& advice);
Remedy RemedyForLag(const Advice& advice);
Remedy RemedyForFading(const Advice& advice);
Remedy RemedyForPosition(const Advice& advice);
Remedy RemedyForMotorAngle(const Advice& advice);
Remedy RemedyForAngleBySpeed(const Advice& advice);

}  // namespace warmjoint

// Whether a log's speeds can tell an angle from time.
#pragma once

#include <warmjoint/recording.h>

#include <optional>

namespace warmjoint {

/// The speed |v|, rad/s or m/s, of a log that moves at one alone: those between its tenth and its ninetieth percentile, rests
/// left out, differ by less than 2 %. What turns with the joint then looks like what is periodic in time for fifty turns.
std::optional<double> OneSpeed(const Measurements& measurements);

}  // namespace warmjoint

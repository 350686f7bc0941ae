// The speed between segments as the positions tell it, in a log whose velocity column tells that of the segments.
#pragma once

#include <warmjoint/prepared_log.h>

#include <vector>

#include "identification/preparation/path_against_velocity.h"

namespace warmjoint {

/// A log with samples put in, `by_velocity`, where the path of each of the ways becomes that of another one,
/// `by_position`: on a way, the samples that are not kept have the velocity of the latter, and the samples put in are
/// its samples, with one right behind the last sample of a segment; nothing is put in within one. So the losses of a change of speed are those of its path, whatever the velocity does between two
/// samples. Ways whose difference is larger than samples can hide, one step at the change of speed, stay as they are:
/// there one of the two is spoilt. taken: the N samples that both have; its selection is that of the result, with the
/// samples put in not kept. by_velocity, by_position: of motion_from_positions.h and split_at_switches.h
LogView ReplaceTransitions(const LogView& taken, const Measurements& by_velocity,
                           const Measurements& by_position, const std::vector<Transition>& ways);

}  // namespace warmjoint

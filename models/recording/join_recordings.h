// Several recordings of one joint as one.
#pragma once

#include <warmjoint/recording.h>

#include <vector>

namespace warmjoint {

/// Recordings one after the other, each from a cold start: a step apart in time, with `starts`
/// where the next begins. A column that one of them lacks is left out, and noted. One recording
/// comes back as it is. Throws BadInput where none is given or units or joint kinds differ.
Measurements JoinRecordings(std::vector<Measurements> recordings);

}  // namespace warmjoint

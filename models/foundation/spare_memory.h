// Memory that is to spare, and refusals before it is taken.
#pragma once

#include <cstdint>
#include <string_view>

#include "models/foundation/bad_input.h"

namespace warmjoint::inline models {

/// Bytes that this process can still take: what the system has available, within the limits on its control group and
/// on its address space. The largest number where the system does not tell.
std::uint64_t SpareMemory();

/// A size in words: "12.5 GiB".
std::string MemoryInWords(double bytes);

/// Throws BadInput from `place` where a task needs more than SpareMemory(). task: what takes it, with the keys that
/// make it so large, as "1e9 samples (duration x sampling.rate)"; remedy: a clause.
void RequireMemory(double bytes, std::string_view task, std::string_view remedy,
                   const Place& place);

}  // namespace warmjoint::inline models

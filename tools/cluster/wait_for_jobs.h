// Waiting for what was submitted.
#pragma once

#include <filesystem>

#include "tools/cluster/plan.h"

namespace warmjoint::inline tools {

/// Returns once none of the run's jobs waits or runs any more; false where it was interrupted, which
/// leaves the jobs as they are. A controller that does not answer is asked again.
bool WaitForJobs(const std::filesystem::path& run, const Plan& plan);

}  // namespace warmjoint::inline tools

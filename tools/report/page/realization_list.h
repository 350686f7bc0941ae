// The answers of a run as a table that can be sorted and filtered.
#pragma once

#include <string>
#include <string_view>

#include "scenarios/suite.h"
#include "tools/report/run/run_view.h"

namespace warmjoint::report {

/// The table, id "realizations", and its controls, which stay hidden where no script runs. Each row has the
/// command that simulates its realization again. run: the run's directory, as the page calls it.
std::string RealizationList(const RunView& view, const Suite& suite, const std::string& run);

/// The script that sorts and filters it; the page's policy names its hash.
std::string_view RealizationScript();
/// Its look.
std::string_view RealizationStyle();

}  // namespace warmjoint::report

// A run for one web page.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenarios/suite.h"
#include "tools/figures/figure.h"
#include "tools/figures/run/run_view.h"
#include "tools/store/run_description.h"

namespace warmjoint::figures {

struct RunPage {
  RunView view;
  Suite suite;
  RunDescription description;
  std::vector<Figure> figures;
  std::optional<Figure> extremes{};  // torque and fit of some realizations
  std::string without_extremes{};    // why there is none, a sentence
};

/// What the template run.html of tools/python/warmjoint shows: question, verdict, what was simulated and by whom it was
/// identified, leaderboard, realizations, figures, failures, terms, how to repeat it.
Tree RunPageData(const RunPage& page);

}  // namespace warmjoint::figures

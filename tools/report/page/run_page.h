// A run on one web page that needs nothing but itself.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenarios/suite.h"
#include "tools/report/draw/figure.h"
#include "tools/report/run/run_view.h"
#include "tools/store/run_description.h"

namespace warmjoint::report {

struct RunPage {
  RunView view;
  Suite suite;
  RunDescription description;
  std::vector<Figure> figures;
  std::optional<Figure> extremes{};  // torque and fit of some realizations
  std::string without_extremes{};    // why there is none, a sentence
};

/// HTML: question, verdict, what was simulated and by whom it was identified, leaderboard, realizations,
/// pictures, failures, terms, how to repeat it. Pictures are inside it; nothing is asked of any server.
/// The leaderboard's JSON stands in a data block, id "board".
std::string MakeRunPage(const RunPage& page);

}  // namespace warmjoint::report

// A run for one web page, with the realizations that stand for it: its best, its median and its worst.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenarios/suite.h"
#include "tools/figures/figure.h"
#include "tools/figures/fit_view.h"
#include "tools/figures/run/run_view.h"
#include "tools/store/run_store.h"

namespace warmjoint::figures {

/// A realization by its rank in parameter error.
struct Extreme {
  std::string rank;  // "best", "median", "worst"
  RunUnit unit;
  double npe = 0;  // continuous, 0.01 is 1 %
};

/// Of the drawn realizations that a row answered: the lowest NPE, the one in the middle (of an even number
/// the lower), and the highest; fewer where there are fewer.
std::vector<Extreme> ExtremesOf(const RunRow& row);

/// One of them, simulated and identified once more.
struct ReplayedExtreme {
  Extreme extreme;
  std::string name;  // of the realization, as a reader names it
  FitView view;
};

/// Torque and fit of each: its level over time, and its last segments as they were logged.
/// label: of the identifier.
Figure ExtremesFigure(const std::string& label, const std::vector<ReplayedExtreme>& replayed);

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

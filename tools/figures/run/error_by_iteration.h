// NPE and RMSE by iteration, as in the paper's Fig. 6.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/board/statistics.h"
#include "tools/figures/figure.h"

namespace warmjoint::figures {

/// One row of the leaderboard by iteration. One that does not iterate has a single iteration, 0,
/// and is drawn as a level.
struct IdentifierCurves {
  std::string label;
  std::string identifier;  // name: gives the colour
  QuartileCurve npe;       // continuous, 0.05 is 5 %
  QuartileCurve rmse;      // N.m or N
};

struct ErrorByIteration {
  std::string suite;
  int realizations = 0;
  std::string torque_unit = "N.m";
  std::vector<IdentifierCurves> identifiers;
  std::optional<double> cramer_rao;  // median NPE at the bound, 0.012 is 1.2 %
  std::optional<double> noise;       // standard deviation of the torque, torque_unit
};

/// Two panels: NPE in % on a logarithmic axis with the Cramer-Rao bound; RMSE with the noise.
Figure MakeErrorByIteration(const ErrorByIteration& data);

}  // namespace warmjoint::figures

// The tests for lack of fit: what each asks of a residual, what it is called, what would help.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "identification/command.h"
#include "identification/identifier.h"
#include "identification/lack_of_fit/circumstances.h"
#include "identification/lack_of_fit/fitted_model.h"
#include "identification/lack_of_fit/growing_fit.h"
#include "identification/lack_of_fit/significance.h"
#include "identification/sentences/findings.h"

namespace warmjoint {

/// What advice is about: the finding, and how the fit was made.
struct Advice {
  const Finding& finding;
  const Identifier& identifier;
  const IdentifierInput& input;
  const Fit& fit;
};

/// When a test looks: at what is known to act on friction first, then at what changes within each
/// segment of constant speed, at samples, where each test has a turn of its own, and then at bins
/// within them, then at what stays.
enum class Stage {
  first,
  fading,
  lag,
  motor_angle,
  motor_angle_by_speed,
  position,
  position_by_speed,
  hold,
  last
};

/// What a fitted warming may have taken up of that which a test looks for; `starts`: that the log began warm.
enum class HeatRelation { independent, confounded, starts };

/// What of a finding counts as a change of the friction: how it moves law and heat (FrictionChange); its own
/// size, its effect, where that is friction or where moves do not show it; or the larger; twice its effect where that
/// understates it, as of a lag. Of a direction its own size, by which the friction of either direction is off. Of a drift beside
/// a law without heat the smaller of the moves and sqrt(10) times the effect, with heat the moves.
enum class Impact { of_moves, of_effect, of_effect_twice, of_direction, of_either, of_drift };

/// Over what residuals show what a test looks for.
enum class SeenOver { time, position, velocity, energy, motor_angle };

/// One row of the table.
struct LackOfFitTest {
  std::string_view name;  // in estimate.json
  TestWords words;
  Stage stage = Stage::first;
  HeatRelation warming = HeatRelation::independent;
  Impact harm = Impact::of_moves;
  SeenOver over = SeenOver::time;
  /// Features over the bins, the best of several candidates beside the fit; of a test that looks
  /// at samples: none.
  Features (*features)(const Bins& bins, const Circumstances& circumstances,
                       const GrowingFit& fit) = nullptr;
  /// What the residual depends on, in a message.
  std::string (*quantity)(const Finding& finding, const LogSamples& measurements) = nullptr;
  /// The law, identifier or recording that helps; names only what is there.
  Remedy (*remedy)(const Advice& advice) = nullptr;
  /// What a test that looks at samples (lag.h, ripple.h) finds; nothing where it is not made.
  /// residual: [N] tau - F; what is found is taken off it.
  std::optional<Finding> (*at_samples)(const LackOfFitTest& test, const FittedModel& model,
                                       const LogSamples& measurements, Eigen::VectorXd& residual,
                                       ErrorLevel& level) = nullptr;
};

/// All rows. Of those over bins the ones that come first are made first where the rows are too few
/// for all.
const std::vector<LackOfFitTest>& LackOfFitTests();

/// The row of that name; nullptr where there is none.
const LackOfFitTest* FindLackOfFitTest(std::string_view name);

}  // namespace warmjoint

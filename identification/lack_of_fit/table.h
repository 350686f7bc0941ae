// The tests for lack of fit: what each looks for in a residual, its name, and its remedy.
#pragma once

#include <warmjoint/fields.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "identification/command.h"
#include "identification/fit/identifier.h"
#include "identification/lack_of_fit/circumstances.h"
#include "identification/lack_of_fit/fitted_model.h"
#include "identification/lack_of_fit/growing_fit.h"
#include "identification/lack_of_fit/significance.h"
#include "identification/sentences/findings.h"

namespace warmjoint {

/// What a remedy depends on: the finding, and how the fit was made.
struct Advice {
  const Finding& finding;
  const Identifier& identifier;
  const IdentifierInput& input;
  const Fit& fit;
};

/// The order of the tests. First are those of known influences on friction. Then come those of structure that changes within
/// each segment of constant speed: at samples, where each test has a stage of its own, and at bins within segments. Last are
/// those of structure that stays from one segment to the next.
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

/// Whether a fitted warming may have taken up a part of the structure that a test looks for (confounded); `starts`: the test
/// looks for a log that began warm.
enum class HeatRelation { independent, confounded, starts };

/// What of a finding counts as a change of the friction. of_moves: how it biases law and heat (FrictionChange). of_effect: its
/// own size, its effect, where that is friction or where biases of parameters do not show it. of_either: the larger of the two.
/// of_effect_twice: twice its effect, where the effect understates it, as of a lag. of_direction: its own size, by which the
/// friction of either direction is off. of_drift: the smaller of the biases and sqrt(10) times the effect where the law has no
/// heat, the biases where it has.
enum class Impact { of_moves, of_effect, of_effect_twice, of_direction, of_either, of_drift };

/// The quantity over which residuals show what a test looks for.
enum class SeenOver { time, position, velocity, energy, motor_angle };

/// One row of the table. It has features, or is made at samples.
struct LackOfFitTest {
  std::string_view name;  // in estimate.json
  TestWords words;
  /// What the residual depends on, in a message. A reference, as is `remedy`, so that no row goes without.
  std::string (&quantity)(const Finding& finding, const LogSamples& measurements);
  /// The law, identifier or recording that helps; it names only what exists.
  Remedy (&remedy)(const Advice& advice);
  Stage stage = Stage::first;
  HeatRelation warming = HeatRelation::independent;
  Impact harm = Impact::of_moves;
  SeenOver over = SeenOver::time;
  /// The field of a fit that takes this up, so that nothing is left to test; or none.
  std::optional<FieldKind> in_field{};
  /// Features over the bins, those of several candidates that explain most in addition to the fit; of a test that looks
  /// at samples: none.
  Features (*features)(const Bins& bins, const Circumstances& circumstances,
                       const GrowingFit& fit) = nullptr;
  /// The finding of a test that looks at samples (lag.h, ripple.h); nothing where it is not made.
  /// residual: [N] tau - F; what is found is subtracted from it.
  std::optional<Finding> (*at_samples)(const LackOfFitTest& test, const FittedModel& model,
                                       const LogSamples& measurements, Eigen::VectorXd& residual,
                                       ErrorLevel& level) = nullptr;
};

/// All rows of the table. Where there are too few bins for all tests over bins, those that come first in the table are made.
const std::vector<LackOfFitTest>& LackOfFitTests();

/// The row of that name; nullptr where there is none.
const LackOfFitTest* FindLackOfFitTest(std::string_view name);

}  // namespace warmjoint

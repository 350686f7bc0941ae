// What follows from a fit: its status, its intervals, and what is wrong with it, as data.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "identification/fit/cause.h"
#include "identification/fit/fit.h"

namespace warmjoint {

/// A part of the half width of an interval.
struct WidthPart {
  Source by = Source::noise;
  double half_width = 0;
};

/// What is known of one row of the fit's table.
struct ParameterInterval {
  double value = 0;  // of the fit, or shifted by the bias that the verdict found
  std::optional<double> std;
  std::optional<std::array<double, 2>> interval95;
  std::vector<WidthPart> parts{};  // which add up to the half width

  double HalfWidth() const { return interval95 ? 0.5 * ((*interval95)[1] - (*interval95)[0]) : 0; }
};

/// Friction at a speed, with what it depends on.
struct SpeedFigure {
  FrictionAtSpeed at;
  Eigen::VectorXd derivatives;     // [P] by the value of each row of the fit's table
  std::vector<WidthPart> parts{};  // which add up to the half width

  double HalfWidth() const { return 0.5 * (at.interval95[1] - at.interval95[0]); }
};

/// Everything that is inferred from one fit.
struct Inference {
  Status status = Status::ok;
  std::string message;
  std::vector<std::string> warnings;
  Uncertainty uncertainty;
  std::vector<ParameterInterval> parameters;  // [P] as the fit's table
  std::vector<SpeedFigure> at_speeds;         // where they are known (speed_figures.h)
  std::vector<Cause> causes;                  // all causes that were applied
  bool gives_friction = false;                // whether the fit's friction may be used
  std::vector<Diagnostic> diagnostics;        // of the verdict, one for each test for lack of fit
  std::vector<Assumption> assumptions;
  /// The inference by the fit's own causes only, of an answer that other causes refused: the numbers that --force shows. Else null.
  std::shared_ptr<const Inference> refused{};
};

/// Whether any number has an interval.
bool HasIntervals(const Inference& inference);

/// The inference from the noise alone, without causes and bounds: values that are not held at bounds, covariance, and intervals
/// with Student's quantile. The interval of a row at its bound begins at the bound.
Inference ByNoise(const Fit& fit);

/// The causes that follow from the fit itself: the rows that it has, and that of its physical bounds (bounds.h).
std::vector<Cause> OwnCauses(const Fit& fit, const Inference& by_noise);

/// The inference from the noise, with the fit's own causes applied.
Inference Infer(const Fit& fit);

/// The parts of a half width of a fit with fields, from its deviations up to each. half: the whole
std::vector<WidthPart> FieldParts(const std::vector<ErrorUpTo<double>>& up_to, double half);

/// The parts of an interval by noise: that of white noise, what colour and unevenness add, and what few segments add.
/// slopes: [p] of the figure by the coordinates; half: of its interval
std::vector<WidthPart> NoiseParts(const Uncertainty& uncertainty, const Eigen::VectorXd& slopes,
                                  double half);

/// Covariance of x, as the fit's error model says, for noise of the colour and the unevenness that
/// the residual shows (uncertainty.h). [p x p] in the coordinates of the parameters.
Uncertainty CovarianceOf(const Fit& fit);

}  // namespace warmjoint

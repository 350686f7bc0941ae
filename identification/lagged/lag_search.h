// Whether a residual shows a lag, and the time constant of a lag that leaves the least squares.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>

#include "identification/lagged/lagged_rows.h"
#include "identification/model/model_squares.h"

namespace warmjoint {

/// Time constants between which a lag is sought, s.
struct LagBracket {
  double below = 0, above = 0;
};

/// The time constant of the least squares: the best of some, refined between its neighbours. squares: of the fit at a time
/// constant; infinite where it has none; refine: to the minimum, from that fit on, which has been made again. Nothing where every
/// fit fails or the best lies at an end of those that can be determined.
std::optional<double> FindLag(const KeptRuns& runs, const std::function<double(double)>& squares,
                              const std::function<double(double, const LagBracket&)>& refine);

/// The rows of any lag, with noise of one colour.
using RowsOfLag = std::function<LaggedRows(double lag)>;

/// log T as one more unknown of a model, by the one solver (minimise.h): from x and a time constant on, within a bracket. samples:
/// as they were measured; variance: about that of the noise. Returns T, s.
double RefineLag(const Model& model, const Eigen::VectorXd& x, const ModelSamples& samples,
                 double variance, const RowsOfLag& rows_of, double lag, const LagBracket& bracket);

/// Whether runs begin with a remainder that a lag would leave. Only runs count that follow another one within its duration.
/// Their remainder, d of LaggedRows, is regressed on the drop of the torque from the end of the run before to their own start,
/// by least squares through the origin. A lag leaves a share above 0, which is tested at one log in a thousand. There is one
/// number for each run, so that neither the colour of the noise nor the rate counts. The test is by Student's t with as many
/// degrees of freedom as runs less one, and Bonferroni over the time constants tried.
/// torque: [n] of the model, without lag; residual: [n] measured less L torque.
bool SeesLag(const LaggedRows& rows, const Eigen::VectorXd& torque,
             const Eigen::VectorXd& residual);

/// Whether the residual of a fit without lag shows one at any time constant tried. torque, residual: [n]
bool ShowsLag(const std::shared_ptr<const KeptRuns>& runs, const Eigen::VectorXd& torque,
              const Eigen::VectorXd& residual);

}  // namespace warmjoint

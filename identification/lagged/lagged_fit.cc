#include "identification/lagged/lagged_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/fit/seen_samples.h"
#include "identification/lagged/lag_search.h"
#include "identification/linear/rigid_part.h"
#include "identification/sentences/late_torque.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Rows of the kept samples. [n x q]
MatrixXd AtKept(const MatrixXd& all, const KeptRuns& runs) { return all(runs.samples, Eigen::all); }

/// AR(1) with a correlation between neighbours, of that variance.
NoiseModel Autoregressive(double correlation, double variance) {
  NoiseModel noise;
  noise.coefficients = VectorXd::Constant(1, -correlation);
  noise.covariances = variance * Eigen::Vector2d(1, correlation);
  noise.variance = variance;
  noise.innovation = variance * (1 - correlation * correlation);
  noise.correlation = correlation;
  noise.variance_inflation = (1 + correlation * correlation) / (1 - correlation * correlation);
  return noise;
}

/// The result of a search.
struct Found {
  std::shared_ptr<const LaggedRows> rows;
  double squares = kInfinity;
};

/// The best lag with noise of one colour. colour: of the time constant; none where it is white.
Found BestOf(const std::shared_ptr<const KeptRuns>& runs, const LagFits& fits,
             const std::function<std::shared_ptr<const Whitening>(double lag)>& colour) {
  const RowsOfLag rows_of = [&](double lag) { return LaggedRows(runs, lag, colour(lag)); };
  // the time constant that leaves least, and the fit there
  const auto lag = FindLag(
      *runs, [&](double trial) { return fits.fit_at(rows_of(trial)).squares; },
      [&](double best, const LagBracket& bracket) { return fits.refine(rows_of, best, bracket); });
  if (!lag) return {};
  Found found{std::make_shared<const LaggedRows>(rows_of(*lag))};
  found.squares = fits.fit_at(*found.rows).squares;
  return found;
}

/// d(L f + d exp(-(t - t0)/T)) / d log T at fixed d, by central differences. [n]
VectorXd ByLogarithm(const LaggedRows& rows, const VectorXd& torque, const VectorXd& held) {
  constexpr double step = 1e-5;
  const auto at = [&](double lag) -> VectorXd {
    const LaggedRows other(rows.runs(), lag);
    return other.Lagged(torque) + other.Decaying(held);
  };
  return (at(rows.lag() * std::exp(step)) - at(rows.lag() * std::exp(-step))) / (2 * step);
}

/// Rows of the kept samples, at their places among all. [N x q]
MatrixXd AtSamples(const MatrixXd& kept, const KeptRuns& runs, Index all) {
  MatrixXd spread = MatrixXd::Zero(all, kept.cols());
  spread(runs.samples, Eigen::all) = kept;
  return spread;
}

}  // namespace

bool AsksForLag(const Options& options) {
  return options.OrDefault<LagOption>().torque_lag == PartFit::estimated;
}

std::optional<std::string> WhyNoLag(const IdentifierInput& input) {
  if (!AsksForLag(input.options)) return std::nullopt;
  if (input.measurements.acceleration) {
    return kLagInAnyMotion;
  }
  if (input.options.Get<LossOption>().loss == LossKind::huber) {
    return kLagUnderHuber;
  }
  return std::nullopt;
}

std::shared_ptr<const LaggedRows> SearchLag(const std::shared_ptr<const KeptRuns>& runs,
                                            const VectorXd& measured, const VectorXd& without,
                                            const LagFits& fits) {
  if (without.size() > 0 && !ShowsLag(runs, without, measured - without)) return nullptr;

  // noise that is white where it joins the torque
  const Found plain = BestOf(runs, fits, [](double) { return nullptr; });
  if (!plain.rows) return nullptr;
  const VectorXd torque = fits.fit_at(*plain.rows).torque;
  if (torque.size() == 0) return nullptr;
  const VectorXd left = measured - plain.rows->Lagged(torque);
  if (!SeesLag(*plain.rows, torque, left)) return nullptr;

  // the colour of the residual, or that of white noise that passed the lag, where the residual is surely coloured
  const Selection grid = AllOf(measured.size());
  const NoiseModel noise = FitNoise(measured - plain.rows->FittedTo(measured, torque), grid);
  if (!IsSurelyColoured(noise, measured.size())) return plain.rows;
  const double step = runs->Step();
  const auto own = WhiteningOfRuns(noise, *runs);
  const Found coloured = BestOf(runs, fits, [&](double) { return own; });
  const Found passed = BestOf(runs, fits, [&](double lag) {
    return WhiteningOfRuns(Autoregressive(std::exp(-step / lag), noise.variance), *runs);
  });
  // both maps have the determinant 1 but for the first samples of runs
  if (passed.squares <= coloured.squares) return passed.rows ? passed.rows : plain.rows;
  return coloured.rows;
}

void AddLag(const std::shared_ptr<const LaggedRows>& rows, const VectorXd& model,
            const LogSamples& m, Fit& fit) {
  const KeptRuns& runs = *rows->runs();
  const VectorXd torque = AtKept(model, runs);
  const VectorXd measured = AtKept(m.torque, runs);
  const VectorXd lagged = rows->Lagged(torque);
  const VectorXd held = rows->InitialStates(measured - lagged).col(0);

  // the model after the lag
  Append({WithValue(LagUnknown(UnitsOf(m)), rows->lag())}, fit);
  fit.rows.torque = measured;
  fit.rows.fitted = lagged + rows->Decaying(held);
  fit.model.lag = rows->lag();
  fit.rows.rest = AtSamples(fit.rows.fitted - torque, runs, m.size());

  // its derivatives by all estimated values, orthogonal to what runs begin with
  fit.rows.jacobian = [rows, of_model = std::move(fit.rows.jacobian), torque, held,
                       all = m.size()] {
    const KeptRuns& kept = *rows->runs();
    MatrixXd columns =
        ConcatColumns(rows->Lagged(AtKept(of_model(), kept)), ByLogarithm(*rows, torque, held));
    columns -= rows->Decaying(rows->InitialStates(columns));
    return AtSamples(columns, kept, all);
  };

  // and the errors of the estimated values; the lag has no prior
  ErrorModel& errors = fit.rows.errors;
  errors.AddFree();
  errors.whitening = rows->whitening();
  errors.cofactor = CofactorOf(fit);

  // the remainders at the starts of runs are fitted, too, which makes the residual smaller than the noise
  const auto samples = static_cast<double>(runs.count());
  const auto begun = static_cast<double>(runs.run_count());
  const double grown = std::sqrt(samples / std::max(samples - begun, 1.0));
  if (!errors.whitening) errors.scores = grown * fit.rows.residual();
  ++fit.rows.count;
  fit.rows.effective_parameters += 1 + begun;
}

}  // namespace warmjoint

// Identifier `rls`: a nominal law online, by recursive least squares.
//
// The linear parameters of a law, sample by sample, with a forgetting factor f: the answer is that
// of weighted least squares with weight f^age, so that with f = 1 it is nominal-ls. All but the
// thermal parameters are linear: with thermal_gain and thermal_time_constant given, the heat of the
// measured losses, H |tau v| without gravity's, is subtracted first, so that the warming does not
// bias the law. The trace holds the parameters at 50 moments of the recording.
// Intervals as in uncertainty.h, for the weighted samples; with a warming they hold the noise that
// comes through the heat, too.
#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <cmath>

#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/forward/thermal_filter.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/inference/inference.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"
#include "identification/model/least_squares.h"
#include "identification/online/kalman_bank.h"
#include "identification/sentences/fit.h"

namespace warmjoint {
namespace {

/// The torque of a known warming, sign(v) E with E = H |F v|, Eqs. (19)-(22), which is subtracted, where F is
/// the torque itself. Friction brakes, so that |F v| = F v, and the map
///     M: y -> sign(v) H (v y)
/// is linear. With the torque y = A p + sign(v) E + G x + e (law, heat, gravity, noise) and
/// F = y - G x - e,
///     (1 - M) y = A p + (1 - M) G x + (1 - M) e:
/// a regression on [A, (1 - M) G] whose noise is no longer e alone. M averages e over the time
/// constant: at each sample little, of standard deviation |k v| (h / 2 tau)^(1/2) that of e, but for
/// so long that it shifts a mean by as much as e itself. Weighted squares with the rows X, weights w
/// and C = (X^T W X)^-1 err by
///     C X^T W (1 - M) e = C B^T e,   B = (1 - M)^T W X,
/// so that their covariance is C B^T R B C with R that of e. Power that brakes a mass comes back
/// when it accelerates, so that F v, unlike |F v|, loses nothing to accelerations.
class MeasuredHeat {
 public:
  MeasuredHeat(const LogSamples& measurements, const Thermal& thermal)
      : thermal_(thermal),
        filter_(measurements.time, measurements.further_starts),
        velocity_(measurements.velocity),
        direction_(measurements.velocity.array().sign()) {}

  /// (1 - M) of each column. columns: [N x q]; returns [N x q].
  Eigen::MatrixXd TakenOff(const Eigen::MatrixXd& columns) const {
    Eigen::MatrixXd result = columns;
    for (Eigen::Index j = 0; j < columns.cols(); ++j) {
      // the loss by the column's force, and the energy that it leaves
      const Eigen::VectorXd loss = velocity_.cwiseProduct(columns.col(j));
      result.col(j) -= direction_.cwiseProduct(filter_.Energy(thermal_, loss));
    }
    return result;
  }

  /// (1 - M)^T of each column. columns: [N x q], 0 at samples without weight; returns [N x q].
  Eigen::MatrixXd Transposed(const Eigen::MatrixXd& columns) const {
    Eigen::MatrixXd result = columns;
    for (Eigen::Index j = 0; j < columns.cols(); ++j) {
      // the same three steps, each transposed, in reverse order
      const Eigen::VectorXd weights = direction_.cwiseProduct(columns.col(j));
      result.col(j) -= velocity_.cwiseProduct(filter_.Transposed(thermal_, weights));
    }
    return result;
  }

 private:
  Thermal thermal_;
  ThermalFilter filter_;
  Eigen::VectorXd velocity_;   // [N] rad/s or m/s
  Eigen::VectorXd direction_;  // [N] its sign
};

constexpr const char* kName = "rls";
constexpr Eigen::Index kMoments = 50;  // of the trace

struct RlsOptions {
  double forgetting = 0.999;
  double thermal_gain = 0;             // N.m/W or N/W
  double thermal_time_constant = 600;  // s

  template <class A>
  void Serialize(A* a) {
    a->Field("forgetting", &forgetting,
             {.bounds = {.above = 0, .at_most = 1},
              .meaning = "weight of a sample relative to the next one"});
    a->Field("thermal_gain", &thermal_gain,
             {.meaning = "known thermal gain, N.m/W or N/W; 0: no warming"});
    a->Field("thermal_time_constant", &thermal_time_constant,
             {.bounds = {.above = 0}, .meaning = "known time constant of warming, s"});
  }
};

/// The thermal part that the options give, if any.
std::optional<Thermal> GivenThermal(const RlsOptions& options) {
  if (options.thermal_gain == 0) return std::nullopt;
  return Thermal{options.thermal_gain, options.thermal_time_constant};
}

/// Weight of each sample, f^age. [n]
Eigen::VectorXd Weights(Eigen::Index n, double forgetting) {
  return Eigen::VectorXd::LinSpaced(n, static_cast<double>(n - 1), 0)
      .unaryExpr([forgetting](double age) { return std::pow(forgetting, age); });
}

/// Runs through the samples; notes the first `noted` parameters at some moments. A: [n x d];
/// y: [n].
Eigen::VectorXd Run(const Eigen::MatrixXd& A, const Eigen::VectorXd& y, double forgetting,
                    Eigen::Index noted, std::vector<Iterate>& trace) {
  constexpr double kDoubt = 1e8;  // prior variance over noise variance of columns of mean square 1
  const Eigen::RowVectorXd scale = A.colwise().norm() / std::sqrt(static_cast<double>(A.rows()));
  auto state = KnowNothing<Eigen::Dynamic>(A.cols(), kDoubt);

  // columns of mean square 1, so that one prior suits them all
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const Eigen::VectorXd row = A.row(i).cwiseQuotient(scale);
    TakeIn<Eigen::Dynamic>(row, y[i], forgetting, state);
    // the estimate at some moments, for the trace
    if ((i + 1) % std::max<Eigen::Index>(A.rows() / kMoments, 1) != 0) continue;
    const Eigen::VectorXd now = state.estimate.cwiseQuotient(scale.transpose());
    const double rmse =
        (y.head(i + 1) - A.topRows(i + 1) * now).norm() / std::sqrt(static_cast<double>(i + 1));
    trace.push_back({static_cast<int>(i + 1), {now.begin(), now.begin() + noted}, rmse});
  }
  return state.estimate.cwiseQuotient(scale.transpose());
}

/// Covariance of an estimate from rows [N x d] with a measured heat, with weights [n] of the kept samples:
/// the noise of all samples acts through the heat, and samples that are not kept are taken to have the same noise
/// as the others. residual: [n]; cofactor: [d x d].
Uncertainty ThroughHeat(const MeasuredHeat& heat, const Eigen::MatrixXd& rows,
                        const Eigen::VectorXd& weights, const Eigen::VectorXd& residual,
                        const Eigen::MatrixXd& cofactor, const Selection& used) {
  // weighted rows over all samples, 0 where not kept
  Eigen::MatrixXd weighted = Eigen::MatrixXd::Zero(rows.rows(), rows.cols());
  Eigen::Index row = 0;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    if (used.keep[i]) weighted.row(i) = weights[row++] * rows.row(i);
  }

  // the noise of all samples comes through the heat
  Uncertainty uncertainty;
  uncertainty.noise = FitNoise(residual, used);
  uncertainty.covariance =
      cofactor * ScatterThrough(uncertainty.noise, heat.Transposed(weighted), AllOf(rows.rows())) *
      cofactor;
  uncertainty.degrees_of_freedom =
      DegreesOfFreedomOfWeights(weights, uncertainty.noise, rows.cols());
  return uncertainty;
}

Fit FitOnline(const IdentifierInput& given) {
  const LogSamples& m = given.measurements;
  LinearTask task = BeginLinear(given, 0);
  if (task.refusal) return Refused(kName, *task.refusal);
  const Law& law = task.law;
  const RigidPart& gravity = task.gravity;
  const IdentifierInput input = gravity.Of(given);

  // the heat of a given warming is subtracted from the torque, and from gravity, which makes no heat
  const std::optional<Thermal> thermal = GivenThermal(input.options.Get<RlsOptions>());
  std::optional<MeasuredHeat> heat;
  if (thermal) heat.emplace(m, *thermal);
  Eigen::VectorXd torque = m.torque;
  Eigen::MatrixXd rows = task.columns;
  if (heat) {
    torque = heat->TakenOff(m.torque);
    rows.rightCols(gravity.count()) = heat->TakenOff(rows.rightCols(gravity.count()));
  }

  // what the remembered samples can distinguish, from their weighted columns
  const double forgetting = input.options.Get<RlsOptions>().forgetting;
  const Eigen::MatrixXd A = Kept(rows, input.selection);
  const Eigen::VectorXd y = Kept(torque, input.selection);
  const Eigen::VectorXd weights = Weights(y.size(), forgetting);
  const Eigen::VectorXd roots = weights.cwiseSqrt();
  const LeastSquares weighted = SolveLeastSquares(roots.asDiagonal() * A, roots.cwiseProduct(y));
  if (weighted.rank < task.count()) {
    return Refused(kName, IndistinctColumns(weighted.mixed, task, input));
  }

  // the law, with gravity and the given warming
  Fit fit;
  fit.identifier = kName;
  const Eigen::VectorXd x = Run(A, y, forgetting, task.law_count(), fit.trace);
  const Eigen::VectorXd values = x.head(task.law_count());
  fit.model.friction = FrictionOf(law, values, m);
  fit.model.friction.thermal = thermal;
  fit.parameters = WithValues(LawUnknowns(law, values.size(), UnitsOf(m)), values);
  AddRigid(gravity, x.tail(gravity.count()), m, fit);

  // and how well they fit
  const Eigen::VectorXd residual = y - A * x;
  fit.rows.used = input.selection;
  fit.rows.torque = Kept(m.torque, input.selection);
  fit.rows.fitted = fit.rows.torque - residual;
  fit.rows.errors.cofactor = weighted.cofactor;
  fit.rows.errors.weights = weights;
  if (heat) {
    fit.rows.errors.covariance = [uncertainty = ThroughHeat(*heat, rows, weights, residual,
                                                            weighted.cofactor, input.selection)] {
      return uncertainty;
    };
  }
  fit.rows.count = task.count();
  fit.rows.effective_parameters = fit.rows.count;
  fit.summary = SummaryOfForgetting(law.name, weights.sum(), y.size());
  fit.rows.jacobian = [all = std::move(rows)] { return all; };
  return fit;
}

}  // namespace

Identifier Rls() {
  return {kName, "a nominal law online, by recursive least squares with forgetting",
          OptionGroups<LawOption, RlsOptions, GravityOption>{}, &FitOnline};
}

}  // namespace warmjoint

#include "identification/score/cramer_rao.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "identification/fit/fit_data.h"
#include "identification/forward/closed_loop.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"
#include "identification/model/normal_equations.h"
#include "identification/warming/thermal_fit.h"

namespace warmjoint {
namespace {

/// Rows W J with W R W^T = sigma^2 I, R the covariance of the noise at the kept samples: for coloured
/// noise the innovations of a scalar Kalman filter that follows it, sigma over their deviation.
/// jacobian: [n x p]; sigma: of the whole noise, N.m or N.
Eigen::MatrixXd Whitened(const Eigen::MatrixXd& jacobian, const LogSamples& measurements,
                         const Selection& selection, const Truth& truth) {
  if (!(truth.correlation_time > 0)) return jacobian;
  const Eigen::VectorXd time = Kept(measurements.time, selection);
  const double sigma = truth.torque_noise, coloured = std::pow(truth.coloured_noise, 2);
  const double white = std::max(sigma * sigma - coloured, 0.0);
  Eigen::MatrixXd rows = jacobian;
  // coloured noise as predicted
  Eigen::RowVectorXd seen = Eigen::RowVectorXd::Zero(jacobian.cols());
  double variance = coloured;  // of what is not seen
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    // the coloured part decays from sample to sample and is renewed
    if (i > 0) {
      const double kept = std::exp(-(time[i] - time[i - 1]) / truth.correlation_time);
      seen *= kept;
      variance = kept * kept * variance + (1 - kept * kept) * coloured;
    }
    // the innovation of the sample, scaled to white noise of deviation sigma
    const double innovation = variance + white;
    const Eigen::RowVectorXd left = jacobian.row(i) - seen;
    rows.row(i) = sigma / std::sqrt(innovation) * left;
    // the share of the innovation that is attributed to coloured noise
    seen += variance / innovation * left;
    variance *= white / innovation;
  }
  return rows;
}

/// Standard deviations of the first `count` parameters; NaN where there are none.
/// jacobian: [n x p] for noise of deviation sigma, N.m or N, that is white.
Eigen::VectorXd Deviations(const Eigen::MatrixXd& jacobian, double sigma, Eigen::Index count) {
  const Eigen::MatrixXd cofactor = Cofactor(GramOf(jacobian));
  if (!(sigma > 0) || !cofactor.allFinite()) {
    return Eigen::VectorXd::Constant(count, std::numeric_limits<double>::quiet_NaN());
  }
  return sigma * cofactor.diagonal().head(count).cwiseSqrt();
}

}  // namespace

CramerRao CramerRaoBound(const LogSamples& measurements, const Selection& selection,
                         const Truth& truth, KnownInitialEnergy initial_energy, double step,
                         const Eigen::MatrixXd& nuisance) {
  const Law& law = *FindLaw(truth.friction.law);
  const auto d = static_cast<Eigen::Index>(law.parameters.size());
  const double sigma = truth.torque_noise;
  const Eigen::Index count = truth.friction.thermal ? d + 2 : d;
  // only linear laws have columns, and with them a bound
  if (!IsLinear(law)) {
    const Eigen::VectorXd none =
        Eigen::VectorXd::Constant(count, std::numeric_limits<double>::quiet_NaN());
    return {none, none, {}};
  }

  // rows of the kept samples, with the columns of what else is fitted, in white noise
  const auto rows_of = [&](const Eigen::MatrixXd& jacobian) {
    const Eigen::MatrixXd all =
        nuisance.size() > 0 ? ConcatColumns(jacobian, nuisance) : Eigen::MatrixXd(jacobian);
    return Whitened(Kept(all, selection), measurements, selection, truth);
  };

  // without warming the Jacobian is the law's columns
  const Eigen::MatrixXd columns = LawColumns(law, truth.velocity);
  if (!truth.friction.thermal) {
    const Eigen::MatrixXd kept = rows_of(columns);
    const Eigen::VectorXd deviations = Deviations(kept, sigma, count);
    return {deviations, deviations, GramOf(kept) / (sigma * sigma)};
  }

  // the closed loop at the truth; its last column is E(0)
  const std::vector<double> values = LawValues(truth.friction);
  const LawBlocks loop({measurements.time, truth.velocity, columns}, columns);
  const Eigen::Index used = initial_energy == KnownInitialEnergy::yes ? d + 2 : d + 3;
  const Eigen::MatrixXd continuous =
      WarmJacobian(loop, Eigen::Map<const Eigen::VectorXd>(values.data(), d),
                   *truth.friction.thermal, truth.initial_energy);
  // the same derivatives by the discrete pair
  const Eigen::MatrixXd discrete = ByDiscretePair(continuous, *truth.friction.thermal, step);
  const Eigen::MatrixXd kept = rows_of(continuous.leftCols(used));
  return {Deviations(kept, sigma, count),
          Deviations(rows_of(discrete.leftCols(used)), sigma, count),
          GramOf(kept) / (sigma * sigma)};
}

}  // namespace warmjoint

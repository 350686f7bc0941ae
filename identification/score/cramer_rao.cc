#include "identification/score/cramer_rao.h"

#include <limits>

#include "identification/fit_data.h"
#include "identification/forward/closed_loop.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/linear_laws.h"

namespace warmjoint::inline identification {
namespace {

/// Standard deviations of the first `count` parameters; NaN where there are none.
/// jacobian: [n x p]; sigma: N.m or N.
Eigen::VectorXd Deviations(const Eigen::MatrixXd& jacobian, double sigma, Eigen::Index count) {
  const Eigen::MatrixXd cofactor = Cofactor(jacobian.transpose() * jacobian);
  if (!(sigma > 0) || !cofactor.allFinite()) {
    return Eigen::VectorXd::Constant(count, std::numeric_limits<double>::quiet_NaN());
  }
  return sigma * cofactor.diagonal().head(count).cwiseSqrt();
}

}  // namespace

CramerRao CramerRaoBound(const Measurements& measurements, const Selection& selection,
                         const Truth& truth, KnownInitialEnergy initial_energy, double step) {
  const Law& law = *FindLaw(truth.friction.law);
  const auto d = static_cast<Eigen::Index>(law.parameters.size());
  const double sigma = truth.torque_noise;
  const Eigen::Index count = truth.friction.thermal ? d + 2 : d;
  if (!IsLinear(law)) {
    const Eigen::VectorXd none =
        Eigen::VectorXd::Constant(count, std::numeric_limits<double>::quiet_NaN());
    return {none, none, {}};
  }

  const Eigen::MatrixXd columns = LawColumns(law, truth.velocity);
  if (!truth.friction.thermal) {
    const Eigen::MatrixXd kept = Kept(columns, selection);
    const Eigen::VectorXd deviations = Deviations(kept, sigma, count);
    return {deviations, deviations, kept.transpose() * kept / (sigma * sigma)};
  }

  // the closed loop at the truth; its last column is E(0)
  const std::vector<double> values = LawValues(truth.friction);
  const ClosedLoop loop(measurements.time, truth.velocity, columns);
  const Eigen::Index used = initial_energy == KnownInitialEnergy::yes ? d + 2 : d + 3;
  const Eigen::MatrixXd continuous =
      loop.Jacobian(Eigen::Map<const Eigen::VectorXd>(values.data(), d), *truth.friction.thermal,
                    truth.initial_energy);
  const Eigen::MatrixXd discrete = ByDiscretePair(continuous, *truth.friction.thermal, step);
  const Eigen::MatrixXd kept = Kept(continuous, selection).leftCols(used);
  return {Deviations(kept, sigma, count),
          Deviations(Kept(discrete, selection).leftCols(used), sigma, count),
          kept.transpose() * kept / (sigma * sigma)};
}

}  // namespace warmjoint::inline identification

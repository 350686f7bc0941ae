#include "identification/adequacy/significance.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "identification/uncertainty/tails.h"

namespace warmjoint::inline identification {

double HotellingDeviations(const Eigen::VectorXd& coefficients, const Eigen::MatrixXd& scatter,
                           double groups) {
  const auto q = static_cast<double>(coefficients.size());
  if (q < 1 || groups <= q + 2) return 0;
  const Eigen::LDLT<Eigen::MatrixXd> factors(scatter);
  if (!(factors.vectorD().minCoeff() > 0)) return 0;
  const double square = coefficients.dot(factors.solve(coefficients));
  const double f = square * (groups - q) / (q * (groups - 1));
  return std::isfinite(f) ? ZOfF(f, q, groups - q) : 0;
}

}  // namespace warmjoint::inline identification

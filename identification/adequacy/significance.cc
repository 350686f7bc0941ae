#include "identification/adequacy/significance.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace warmjoint::inline identification {

double NormalOfF(double f, double m, double n) {
  const double root = std::cbrt(f);
  const double a = 2 / (9 * m), b = 2 / (9 * n);
  return ((1 - b) * root - (1 - a)) / std::sqrt(b * root * root + a);
}

double HotellingDeviations(const Eigen::VectorXd& coefficients, const Eigen::MatrixXd& scatter,
                           double groups) {
  const auto q = static_cast<double>(coefficients.size());
  if (q < 1 || groups <= q + 2) return 0;
  const Eigen::LDLT<Eigen::MatrixXd> factors(scatter);
  if (!(factors.vectorD().minCoeff() > 0)) return 0;
  const double square = coefficients.dot(factors.solve(coefficients));
  const double f = square * (groups - q) / (q * (groups - 1));
  return std::isfinite(f) ? NormalOfF(f, q, groups - q) : 0;
}

}  // namespace warmjoint::inline identification

#include "identification/lack_of_fit/significance.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "identification/uncertainty/tails.h"

namespace warmjoint {

double HotellingPValue(const Eigen::VectorXd& coefficients, const Eigen::MatrixXd& scatter,
                       double groups) {
  const auto q = static_cast<double>(coefficients.size());
  if (q < 1 || groups <= q + 2) return 1;
  // a scatter that vanishes along some direction tells nothing
  const Eigen::LDLT<Eigen::MatrixXd> factors(scatter);
  if (!(factors.vectorD().minCoeff() > 0)) return 1;
  const double square = coefficients.dot(factors.solve(coefficients));
  const double f = square * (groups - q) / (q * (groups - 1));
  return std::isfinite(f) ? PValueOfF(f, q, groups - q) : 1;
}

}  // namespace warmjoint

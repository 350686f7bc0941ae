#include "identification/lack_of_fit/significance.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "identification/uncertainty/tails.h"

namespace warmjoint {

bool ErrorLevel::WouldReject(Finding& finding) const {
  finding.p_adjusted = std::min(1.0, finding.p * std::max(remaining_, 1));
  return finding.explained > 0 && finding.p_adjusted <= kErrorLevel;
}

bool ErrorLevel::Rejects(Finding& finding) {
  finding.rejected = WouldReject(finding);
  remaining_ -= finding.rejected;
  return finding.rejected;
}

double HotellingPValue(const Eigen::VectorXd& coefficients, const Eigen::MatrixXd& scatter,
                       double groups) {
  const auto q = static_cast<double>(coefficients.size());
  if (q < 1 || groups <= q + 2) return 1;
  // a scatter that vanishes along some direction shows nothing
  const Eigen::LDLT<Eigen::MatrixXd> factors(scatter);
  if (!(factors.vectorD().minCoeff() > 0)) return 1;
  const double square = coefficients.dot(factors.solve(coefficients));
  const double f = square * (groups - q) / (q * (groups - 1));
  return std::isfinite(f) ? PValueOfF(f, q, groups - q) : 1;
}

}  // namespace warmjoint

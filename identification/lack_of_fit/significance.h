// How far from chance a sum over parts of a recording is.
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace warmjoint {

/// Share of the logs without any lack of fit in which a test of the table finds one by chance.
inline constexpr double kErrorLevel = 0.01;

/// Holm's step-down procedure (Holm 1979, Scand. J. Statist. 6, 65): a p-value counts times the
/// number of tests that are not rejected yet. Whatever depends on what among the tests, one of
/// them rejects by chance in a share `level` of the logs at most.
class ErrorLevel {
 public:
  /// tests: all of the log, those counted that come later.
  explicit ErrorLevel(int tests, double level = kErrorLevel) : remaining_(tests), level_(level) {}

  double Adjusted(double p) const { return std::min(1.0, p * std::max(remaining_, 1)); }

  /// Whether a test with that p-value rejects.
  bool WouldReject(double p) const { return Adjusted(p) <= level_; }

  /// The same; the next tests then count as one fewer.
  bool Rejects(double p) {
    if (!WouldReject(p)) return false;
    --remaining_;
    return true;
  }

 private:
  int remaining_;
  double level_;
};

/// The probability that q coefficients differ from 0 together as far as these by chance, where
/// `scatter` [q x q] was summed over `groups` parts of the recording: Hotelling's
/// T^2 = b^T scatter^-1 b, F = T^2 (groups - q)/(q (groups - 1)) with q and groups - q degrees of
/// freedom. 1 where the parts are too few to tell, groups <= q + 2.
double HotellingPValue(const Eigen::VectorXd& coefficients, const Eigen::MatrixXd& scatter,
                       double groups);

}  // namespace warmjoint

// One error level for all tests of a log.
#pragma once

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

}  // namespace warmjoint

// What one test for lack of fit found in a residual, and how far that is from chance.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identification/parts.h"

namespace warmjoint {

struct LackOfFitTest;

/// Outcome of a test. A test that was not made keeps p = 1 and says why.
struct Finding {
  const LackOfFitTest* test = nullptr;
  bool made = false;
  std::string reason;     // why not made
  bool is_held = false;   // by a field of the fit, so that nothing is left to test
  double p = 1;           // by chance, the candidates within the test counted
  double p_adjusted = 1;  // the tests of the log counted (ErrorLevel)
  bool rejected = false;
  double explained = 0;  // squares of the residual's samples that it explains, less the noise's
  double gain = 0;       // the same less ln(m) times the noise's variance for each feature, as BIC
      // has it: of two that explain as much, the one with fewer features gains more
  /// Of a ripple, in the unit of the angle; of what is periodic in time, or the time constant of a
  /// memory, s; 0: none.
  double period = 0;
  std::vector<double> periods{};  // of a ripple: of all waves that were found, the strongest first
  double lag = 0;                 // of the torque after the velocity, s; 0: none
  double alike = 0;               // share of an angle's part that acts alike in both directions
  Eigen::VectorXd moves;  // [p] change of the fit's parameters when the features join it; or empty
  Eigen::MatrixXd move_spread;  // [p x k] S, the covariance of `moves` is S S^T
  double harm =
      0;  // of one that was rejected: how far it changes the friction, as a share of its rms (HarmOf)
};

/// Share of the logs without any lack of fit in which a test of the table finds one by chance.
inline constexpr double kErrorLevel = 0.01;

/// Holm's step-down procedure (Holm 1979, Scand. J. Statist. 6, 65): a p-value counts times the
/// number of tests that have not rejected yet. Whatever the dependence between the tests, one or more of
/// them reject by chance in a share kErrorLevel of the logs at most.
class ErrorLevel {
 public:
  /// tests: the number of all tests of the log, those that come later included.
  explicit ErrorLevel(int tests) : remaining_(tests) {}

  /// Adjusts a finding's probability for the number of tests of the log. Returns whether it is then beyond chance, and
  /// the finding explains anything.
  bool WouldReject(Finding& finding) const;

  /// The same, entered in the finding; the next tests then count as one fewer.
  bool Rejects(Finding& finding);

 private:
  int remaining_;
};

/// The probability that q coefficients differ from 0 together as far as these by chance, where
/// `scatter` [q x q] was summed over `groups` parts of the recording: Hotelling's
/// T^2 = b^T scatter^-1 b, F = T^2 (groups - q)/(q (groups - 1)) with q and groups - q degrees of
/// freedom. 1 where there are too few parts for a test, groups <= q + 2.
double HotellingPValue(const Eigen::VectorXd& coefficients, const Eigen::MatrixXd& scatter,
                       double groups);

}  // namespace warmjoint

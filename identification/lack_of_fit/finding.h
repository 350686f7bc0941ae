// What one test for lack of fit found in a residual.
#pragma once

#include <Eigen/Core>
#include <string>

namespace warmjoint {

struct LackOfFitTest;

/// Outcome of a test. A test that was not made keeps p = 1 and says why.
struct Finding {
  const LackOfFitTest* test = nullptr;
  bool made = false;
  std::string reason;     // why not made
  double p = 1;           // by chance, the candidates within the test counted
  double p_adjusted = 1;  // the tests of the log counted (significance.h)
  bool rejected = false;
  double explained = 0;  // squares of the residual's samples that it explains, less the noise's
  double gain = 0;       // the same less ln(m) times the noise's variance for each feature, as BIC
      // has it: of two that explain as much, the one with fewer features gains more
  /// Of a ripple, in the unit of the angle; of what is periodic in time, or the time constant of a memory,
  /// s; 0: none.
  double period = 0;
  double lag = 0;         // of the torque behind the velocity, s; 0: none
  double alike = 0;       // share of an angle's part that acts alike in both directions
  Eigen::VectorXd moves;  // [p] change of the fit's parameters when the features join it; or empty
  Eigen::VectorXd move_deviations;  // [p] standard deviations of `moves`
  double harm =
      0;  // of one that was rejected: how far it changes the friction, as a share of its rms (HarmOf)
};

/// Parts of a recording that count as independent of each other: noise may be coloured within them.
inline constexpr Eigen::Index kParts = 32;

}  // namespace warmjoint

// Of what the tests for lack of fit found in the residual, and of its effect on the answer.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "identification/sentences/moved_parameter.h"

namespace warmjoint {

// why nothing can be examined
inline constexpr const char* kFitGivesNoFriction = "the fit gives no friction";
inline constexpr const char* kResidualIsNotFinite = "the residual is not finite";
inline constexpr const char* kFitIsExact =
    "the fit is exact: the residual is the rounding of its numbers";
/// rows: samples or segments
std::string ExplainFewRows(Eigen::Index rows);
/// The sentence about a fit that is not ok. status: its name
std::string ExplainNotExamined(std::string_view status);

// why one test is not made
inline constexpr const char* kBristleFollowsDistance =
    "the law has a bristle, whose force follows the distance by itself";
std::string ExplainFewRowsOfTest(Eigen::Index rows);

/// The finding of a test for lack of fit.
struct FoundPart {
  std::string quantity;                     // that the residual depends on
  double rms = 0;                           // in the torque's unit
  double of_friction = 0, of_residual = 0;  // rms and variance, %
};

/// "the residual depends on ...": each finding with its size, the largest first; its effect on the answer, by one of the next
/// two functions; a remedy.
std::string ExplainFindings(const std::vector<FoundPart>& found, const std::string& unit,
                            std::string_view effect, std::string_view remedy);
/// Why a fit without gravity failed whose joint carries a weight.
std::string ExplainWeight(const std::string& identifier);
/// The effect of findings that change the friction too much: the worst by --relevance, or all together. harm: share
std::string ExplainTooMuch(std::string_view quantity, double harm, double relevance);
std::string ExplainTooMuchTogether(double share, double most);
/// The effect of findings for which intervals were widened. worst: share by which one changes the friction, rms over the log; largest: the
/// share by which they change it at the speed where they change it most
std::string ExplainWidened(double worst, double largest);
inline constexpr const char* kAbsorbedByWarming =
    ", and the parameters of warming have none, since they may have absorbed part of it";

/// The sentence about findings by tests that reject only before adjustment, and the parameter that they change most. remedy: a clause
std::string ExplainUnadjusted(const std::vector<std::string>& quantities,
                              const MovedParameter& moved, std::string_view remedy);
inline constexpr const char* kLongerTells = "; a longer recording tells";

}  // namespace warmjoint

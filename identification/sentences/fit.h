// Of how a fit was made, and whether it converged.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <string_view>

#include "identification/fit/cause.h"

namespace warmjoint {

/// The samples of a fit.
struct FittedSamples {
  Eigen::Index count = 0;
  bool is_any_motion = false;  // in motion of any kind, with inertia
  bool is_lagged = false;      // with a lag of the torque
  bool is_whitened = false;    // the rows were
};
/// "5000 samples of motion of any kind, with inertia, whitened".
std::string NameOfSamples(const FittedSamples& samples);

// what was done: a clause
/// The summary of a law without heat.
std::string SummaryOfLeastSquares(std::string_view law, const FittedSamples& samples);
/// The summary of law and heat. iterations: after the first fit
std::string SummaryOfLikelihood(const FittedSamples& samples, std::size_t iterations);
/// The summary of recursive least squares with forgetting. remembered: by the weights, of all samples
std::string SummaryOfForgetting(std::string_view law, double remembered, Eigen::Index samples);
/// The summary of a filter. energy: E at the end of the log, in `unit`
std::string SummaryOfFilter(std::size_t passes, Eigen::Index samples, double energy,
                            std::string_view unit);

// what is known of the noise: clauses that join the summary
/// The sentence about outliers under Huber's loss. deviations: how many standard deviations they exceed
std::string ExplainOutliers(Eigen::Index outliers, Eigen::Index samples, double deviations);
/// The sentence about coloured noise. correlation: between neighbours
std::string ExplainColour(double correlation);
/// The sentence about noise whose variance is not constant. errors: by how many standard errors
std::string ExplainUnevenness(double errors);

inline constexpr const char* kTooLargeToSquare = "torque or velocity is too large to square";
inline constexpr const char* kNoIntervalsInTurn = "gives no intervals, energy-ml does";
inline constexpr const char* kNoIntervalsOfOnePass = "intervals need more than one pass";
inline constexpr const char* kPassesStillMove =
    "the last pass still moved parameters by more than their standard deviation; give more passes, "
    "or try --identifier energy-ml";
inline constexpr const char* kForced = "forced: all numbers are void";

// of a fit that did not converge
inline constexpr const char* kWeightsStillMove =
    "the weights of Huber's loss still move after 100 rounds; use loss squares";
inline constexpr const char* kRanAway = "the filters ran away";
/// The sentence about iterations on law and heat, or on a law that falls.
std::string ExplainUnconverged(std::size_t iterations);
/// The sentence about an alternation that converged. remaining: share by which parameters will still change
std::string ExplainArrived(std::size_t iterations, double rate, double remaining);
/// The sentence about an alternation that did not converge. remaining: share by which parameters will still change
std::string ExplainStopped(std::size_t iterations, double rate, double remaining, double tolerance);

inline constexpr const char* kFollowsOneRecording =
    "kalman follows one recording; give one, or try --identifier energy-ml for several";

// why a fit is not compared with samples that it has not seen
inline constexpr const char* kKnowsNoGravityThere =
    "the fit knows gravity at none of the places it reaches";
inline constexpr const char* kNothingMoves = "no sample moves clearly";
inline constexpr const char* kNothingHoldsASpeed = "no sample moves at a constant speed";
inline constexpr const char* kHeatOfItsOwn = "each recording begins with a heat of its own";
inline constexpr const char* kPredictsNothing = "the fit gives no friction that could predict them";
/// The sentence about parts of the log with too few samples; the next are about a first part whose fit gives no friction, and a
/// last part that is not compared. held_out: share of the log, at its end; why: a clause
std::string ExplainShortParts(double held_out);
std::string ExplainNoFrictionBefore(double held_out, std::string_view why);
std::string ExplainNotHeldOut(double held_out, std::string_view why);
/// The sentence about another recording that is not predicted. why: a clause
std::string ExplainNotPredicted(std::string_view source, std::string_view why);

/// The sentence about structure in the residual that intervals were widened for, or that leaves none (drop_intervals). name: of the
/// parameter that changes by most standard errors, `deviations`, where it counts as noise
std::string ExplainStructure(std::string_view name, double deviations, Action action);

}  // namespace warmjoint

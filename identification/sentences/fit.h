// Of how a fit was made, and whether it came to rest.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <string_view>

#include "identification/inference/cause.h"

namespace warmjoint {

/// Samples that a fit rests on.
struct FittedSamples {
  Eigen::Index count = 0;
  bool is_any_motion = false;  // in motion of any kind, with inertia
  bool is_lagged = false;      // with a lag of the torque
  bool is_whitened = false;    // the rows were
};
/// "5000 samples of motion of any kind, with inertia, whitened".
std::string NameOfSamples(const FittedSamples& samples);

// what was done: a clause
/// Of a law without heat.
std::string SummaryOfLeastSquares(std::string_view law, const FittedSamples& samples);
/// Of law and heat. iterations: after the first fit
std::string SummaryOfLikelihood(const FittedSamples& samples, std::size_t iterations);
/// Of a law that forgets. remembered: by the weights, of all samples
std::string SummaryOfForgetting(std::string_view law, double remembered, Eigen::Index samples);
/// Of a filter. energy: E at the end of the log, in `unit`
std::string SummaryOfFilter(std::size_t passes, Eigen::Index samples, double energy,
                            std::string_view unit);

// what is known of the noise: clauses that join the summary
/// Of outliers under Huber's loss, more than so many standard deviations off.
std::string ExplainOutliers(Eigen::Index outliers, Eigen::Index samples, double deviations);
/// Of coloured noise. correlation: between neighbours
std::string ExplainColour(double correlation);
/// Of noise that is not even, by so many standard errors.
std::string ExplainUnevenness(double errors);

inline constexpr const char* kTooLargeToSquare = "torque or velocity is too large to square";
inline constexpr const char* kNoIntervalsInTurn = "gives no intervals, energy-ml does";
inline constexpr const char* kNoIntervalsOfOnePass = "intervals need more than one pass";
inline constexpr const char* kPassesStillMove =
    "the last pass still moved parameters by more than their standard deviation; give more passes, "
    "or try --identifier energy-ml";
inline constexpr const char* kForced = "forced: all numbers are void";

// of a fit that did not come to rest
inline constexpr const char* kWeightsStillMove =
    "the weights of Huber's loss still move after 100 rounds; use loss squares";
inline constexpr const char* kRanAway = "the filters ran away";
/// Of iterations on law and heat, or on a law that falls.
std::string ExplainUnconverged(std::size_t iterations);
/// Of an alternation that arrived. remaining: share by which parameters will still change
std::string ExplainArrived(std::size_t iterations, double rate, double remaining);
/// Of an alternation that did not arrive. remaining: share by which parameters will still change
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
/// Of parts of the log with too few samples, of a first part without friction, and of a last one that is not compared. held_out: share
/// of the log, at its end; why: a clause
std::string ExplainShortParts(double held_out);
std::string ExplainNoFrictionBefore(double held_out, std::string_view why);
std::string ExplainNotHeldOut(double held_out, std::string_view why);
/// Of another recording. why: a clause
std::string ExplainNotPredicted(std::string_view source, std::string_view why);

/// Of structure in the residual that intervals were widened for, or that leaves none (drop_intervals). name: of the
/// parameter that changes by most standard errors, `deviations`, where it counts as noise
std::string ExplainStructure(std::string_view name, double deviations, Action action);

}  // namespace warmjoint

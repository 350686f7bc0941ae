// The sentences about an answer, from the rows of its causes.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>

#include <optional>
#include <string>
#include <vector>

#include "identification/identifier.h"
#include "identification/inference/cause.h"
#include "identification/inference/inference.h"
#include "identification/lack_of_fit/examine.h"

namespace warmjoint {

/// What a sentence needs besides its row.
struct Explained {
  const Identifier& identifier;
  const IdentifierInput& input;
  const Fit& fit;
  const Inference& by_noise;
};

/// Of a start that is not known.
inline constexpr const char* kCoversWarmStart =
    "the intervals also cover a start at a tenth of the warmth that the joint reaches";

/// Of a start that was taken to be cold: how far a warm one would move a parameter beyond its interval; empty where none.
std::string ExplainColdStart(const Cause& cause, const Explained& of);

/// Of losses that may follow the heat within a step of the log.
std::string ExplainHeldLosses(const Cause& cause, const Explained& of);

/// Of gaps in the log.
std::string ExplainGaps(const LogSamples& measurements);

/// Of a torque in steps, whose effect was taken off or hides; empty where it stays within all intervals.
std::string ExplainRounding(const Cause& cause, const Explained& of);

/// "the residual depends on ...": each finding with its size, the largest first.
std::string ExplainFindings(const Examination& examination, const LogSamples& measurements);

/// Of findings that change the friction too much: the worst by --relevance, or all together. worst: the one that changes it most.
std::string ExplainTooMuch(const Finding& worst, double relevance, const LogSamples& measurements);
std::string ExplainTooMuchTogether(double share, double most);

/// Of findings that intervals were widened for. largest: share by which one changes the friction.
std::string ExplainWidened(double largest, bool without_warming);

/// Of hints; empty where they stay within all intervals.
std::string ExplainHints(const Cause& cause, const Examination& examination, const Explained& of);

/// Of a fit to few samples, and of one that the torque's mean beats. fit_share: Fit, %
std::string ExplainFewSamples(double used, double moving, double fewest, double least_share,
                              bool any_motion);
std::string ExplainWorseThanMean(double fit_share);

/// Of an estimate of others whose own law fits its log better. change: of the parameter that is farthest off
std::string ExplainOwnLaw(const FitParameter& parameter, double change);

/// Of a velocity that was averaged over each segment, and of what that left of its noise. slope: what slopes over speed; empty: nothing.
std::string ExplainAveraging(const VelocityNoise& taken, JointKind joint, std::string_view slope);
std::string ExplainVelocityNoise(const VelocityNoise& taken, std::string_view slope);

/// Of reversals between two samples. unseen: share of the path
std::string ExplainReversals(double unseen);

/// "cold_start" and "open_start" where a start was taken to be cold; "no_slow_drift", "open_drift", "open_curve", "open_memory",
/// "no_dead_band" and "true_clock" where anything was fitted, "angles_in_radians" where a joint turns. unit: of the
/// torque
std::vector<Assumption> AssumptionsOf(const std::vector<Cause>& causes, const Fit& fit,
                                      const std::string& unit);

/// Changes of a row's parameters by their names.
ParameterMoves NamedMoves(const std::vector<size_t>& rows, const Eigen::VectorXd& moves,
                          const Fit& fit);

}  // namespace warmjoint

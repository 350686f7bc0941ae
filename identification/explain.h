// The sentences about an estimate. Their numbers and conditions come from where a row (Cause) is made.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>
#include <warmjoint/recording.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "identification/fit.h"
#include "identification/inference/cause.h"

namespace warmjoint {

/// A parameter, and how far something changes it, in its unit.
struct MovedParameter {
  const FitParameter& parameter;
  double change = 0;
};

/// A parameter of the law outside of its physical bound.
struct Excess {
  const FitParameter& parameter;
  std::optional<std::array<double, 2>> interval95;
  double bound = 0;
  bool below = false;   // the bound; else above
  bool beyond = false;  // with its whole 95 % interval
};

// of the law
/// Of parameters that were set to their bounds, and of one beside maps.
std::string ExplainHeld(const std::vector<Excess>& held);
std::string ExplainHeldBesideMaps(const FitParameter& parameter);
/// Of a law that does not describe the data: by one of its parameters, or since friction rises from rest.
std::string ExplainExcess(const Excess& excess, const Fit& fit);
std::string ExplainRiseFromRest(const Fit& fit);
/// Of a fitted friction that drives the joint at a time, s.
std::string ExplainDriving(double time, std::string_view remedy);
/// What to try then, which the fit does not hold already: another law, else gravity, else the torque's sign.
/// law: of the fit; gravity: its option.
std::string RemedyForNonDissipative(std::string_view law,
                                    FittedGravity gravity = FittedGravity::none);
/// Of structure in the residual that intervals were widened for, or that leaves none (drop_intervals). name: of the
/// parameter that changes by most standard errors, `deviations`, where it counts as noise
std::string ExplainStructure(std::string_view name, double deviations, Action action);
/// Of a law that misses what happens at turns. Residuals, rms in `unit`
std::string ExplainTurns(double at_turns, double at_constant_speeds, const std::string& unit);

// of how a fit was made
inline constexpr const char* kNoLagSeen = "the torque shows no lag, so that none is fitted";
inline constexpr const char* kNoIntervalsInTurn = "gives no intervals, energy-ml does";
inline constexpr const char* kNoIntervalsOfOnePass = "intervals need more than one pass";
inline constexpr const char* kPassesStillMove =
    "the last pass still moved parameters by more than their standard deviation; give more passes, "
    "or try --identifier energy-ml";
inline constexpr const char* kForced = "forced: all numbers are void";
/// Of an alternation that did not arrive. remaining: share by which parameters will still change
std::string ExplainStopped(std::size_t iterations, double rate, double remaining, double tolerance);
/// Of a torque that is late, s; below 0: early. step: of the log, s
std::string ExplainDelay(double delay, double step);
/// Of one that the log may hold and does not tell, which intervals cover.
std::string ExplainUntoldDelay(double delay, double step);
/// Of one that a fit leaves out, with the share by which that changes the friction.
std::string ExplainDelayLeftOut(double delay, double step, double harm,
                                std::string_view identifier);
/// Of samples left out because the torque lags, s.
std::string ExplainLeftOutByLag(double lag);

/// Of samples left out since the torque takes so long, s, to settle after a change of speed.
std::string ExplainSettling(double settling);

// of heat (explain_heat.cc)
inline constexpr const char* kWithoutWarming = "without warming: ";  // why not
inline constexpr const char* kOthersBeginCold =
    "what is expected of E(0) is taken for the first recording, and the others are taken to begin "
    "cold; use --start estimated if they did not";
/// Of a start that is not known.
inline constexpr const char* kCoversWarmStart =
    "the intervals also cover a start at a tenth of the warmth that the joint reaches";
/// Of a start that was taken to be cold: what a warm one would move. begins: first time of the log, s
std::string ExplainColdStart(const MovedParameter& moved, double begins, std::string_view remedy);
/// Of a log that contradicts what was expected of E(0), with its standard deviation, N.m or N.
std::string ExplainUnexpectedStart(double found, double expected, double deviation);
/// Of losses that may follow the heat within a step of the log, s. change: of thermal_time_constant, s, which has it (shift)
/// or an interval that covers it
std::string ExplainHeldLosses(double step, double change, Action action);
/// Of gaps in the log whose losses are estimated, or which intervals cover (widen). time: [N] s
std::string ExplainGaps(const std::vector<LogGap>& gaps, const Eigen::VectorXd& time,
                        Action action);
/// Of a log that shows no warming: by how much it lowers the squared residuals, in variances of the noise, where `needed` count. beside: what
/// stands beside it, "" or words that begin with a blank; instead: the identifier that fits without
std::string ExplainUnseenWarming(double lowers, double needed, std::string_view beside,
                                 std::string_view instead);
/// Of a warming that is faster than heat, s.
std::string ExplainFastWarming(double time_constant, double fastest, std::string_view instead);
/// Of gain and time constant that trade off: since the latter, in s, lies outside of what the log can show, since it is known to a factor,
/// or not at all; and since it is longer than the log's duration, s, by far.
std::string ExplainHiddenTimeConstant(double time_constant, double shortest, double longest);
std::string ExplainVagueTimeConstant(double factor);
std::string ExplainUnknownTimeConstant();
std::string ExplainRunawayTimeConstant(double duration);
/// Of warming beside maps, and of maps over the energy that it gives.
std::string ExplainWarmingBesideMaps(int iterations);
std::string ExplainMapsOverEnergy(int rounds);

// of maps
inline constexpr const char* kMapHoldsGravity =
    "the map holds what acts alike in both directions, as gravity does, which is no friction; add "
    "--gravity sincos";
inline constexpr const char* kMotorTurnsWithJoint =
    "the motor is taken to turn with the joint: give --gear, or log motor_position";
/// Of parameters, by their names, that maps can imitate.
std::string ExplainImitated(const std::vector<std::string>& names);
/// Of friction below 0 at a speed, beside the gravity that the fit has.
std::string ExplainDrivingFriction(const FrictionAtSpeed& at, const LogSamples& measurements,
                                   const Fit& fit);
/// Of places without data (NameHoles).
std::string ExplainHoles(const std::vector<std::string>& holes);
/// Of a motor's ripple. harmonics: how often a turn, and amplitude in `unit`
std::string ExplainMotorRipple(bool forwards, const std::vector<std::pair<int, double>>& harmonics,
                               const std::string& unit);

/// What a test for lack of fit found.
struct FoundPart {
  std::string quantity;                     // that the residual depends on
  double rms = 0;                           // in the torque's unit
  double of_friction = 0, of_residual = 0;  // rms and variance, %
};

// of what the residual shows
/// "the residual depends on ...": each finding with its size, the largest first; what that does, as below; a remedy.
std::string ExplainFindings(const std::vector<FoundPart>& found, const std::string& unit,
                            std::string_view effect, std::string_view remedy);
/// What findings do that change the friction too much: the worst by --relevance, or all together. harm: share
std::string ExplainTooMuch(std::string_view quantity, double harm, double relevance);
std::string ExplainTooMuchTogether(double share, double most);
/// What those do that intervals were widened for. largest: share by which one changes the friction.
std::string ExplainWidened(double largest);
inline constexpr const char* kAbsorbedByWarming =
    ", and the parameters of warming have none, since they may have absorbed part of it";
inline constexpr const char* kLongerTells = "; a longer recording tells";
/// Of findings by tests that reject before adjustment alone, and the parameter that they move farthest. remedy: a clause
std::string ExplainUnadjusted(const std::vector<std::string>& quantities,
                              const MovedParameter& moved, std::string_view remedy);
/// Of a torque in steps, whose effect was taken off (shift) or hides. step: in `unit`
std::string ExplainRounding(double step, const std::string& unit, const MovedParameter& moved,
                            Action action);
/// Of a fit to few samples, and of one that the torque's mean beats. motion: of the fit; fit_share: Fit, %
std::string ExplainFewSamples(double used, double moving, double fewest, double least_share,
                              MotionKind motion);
std::string ExplainWorseThanMean(double fit_share, const Fit& fit);
/// Of one that explains little of the torque in both directions, and of one that the mean of unseen samples beats, %.
std::string ExplainPoorFit(double fit_share, double least, const Fit& fit);
std::string ExplainWorseHeldOut(double fit_share, const Fit& fit);
/// Of one that leaves much beside its friction, both rms.
std::string ExplainMuchLeft(double left, double friction, const Fit& fit);
/// Of a torque without friction, which has that share of it, and of an inertia below 0.
std::string ExplainNoFriction(double share);
std::string ExplainNegativeInertia(const FitParameter& inertia,
                                   const std::array<double, 2>& interval95);
/// Of friction at speeds whose intervals reach to 0: of all, and of some that are left out.
std::string ExplainUnknownFriction(const std::vector<FrictionAtSpeed>& all);
std::string ExplainLeftOutSpeeds(const std::vector<FrictionAtSpeed>& left_out);
/// Of a law's levels, by their names, where the log moves at one speed each way. speeds: rad/s or m/s, in `unit`
std::string ExplainOneSpeed(const std::vector<std::string>& names,
                            const std::vector<double>& speeds, const std::string& unit);
/// "friction forwards at 0.5 rad/s, warm".
std::string NameOfFriction(const FrictionAtSpeed& at);
/// Of an estimate of others whose own law fits its log better. moved: the parameter that is farthest off
std::string ExplainOwnLaw(const MovedParameter& moved);

// of the log
/// Of faults (log_faults.h).
std::string ExplainFaults(const std::vector<std::string>& faults);
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

// A start of which something is known: what a recording before left of the heat.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "identification/identifier.h"
#include "identification/options.h"
#include "identification/warming/warm_fit.h"

namespace warmjoint::inline identification {

/// The option that says what is known of E(0).
inline constexpr const char* kStartOption = "initial_energy";

/// The rows of the table of options that say what is known of E(0).
std::vector<OptionInfo> InitialEnergyOptions();

/// Whether an identifier has them.
bool TellsStart(const Identifier& identifier);

/// What options say of it beside their defaults, by name: for an identifier that fits by another one.
std::map<std::string, std::string> StartAsGiven(const Options& options);

/// Whether they take the joint for cold as the log begins.
bool TakesColdStart(const Options& options);

/// What they say.
InitialEnergy InitialEnergyOf(const Options& options);

/// The sentence that the log itself contradicts what was expected, by more than four deviations of both;
/// empty where it does not. found: E(0) in a fit that knows nothing of it, deviation: of that, N.m or N.
std::string UnlikeBefore(const InitialEnergy& expected, double found, double deviation);

/// Fits once more where E(0) was expected, by the noise that the fit leaves: the fit before it knew no
/// noise to weigh the expectation by. Where the log contradicts what was expected (UnlikeBefore), E(0) is estimated from the log alone. loop, level, offsets, kept: as of
/// FitWarmFriction; fit: takes the place of the one given. deviation: of E(0) in a fit that knows
/// nothing of it, N.m or N. Returns the clause that tells of a contradiction, else an empty text.
std::string WeighStart(const ClosedLoop& loop, const Eigen::VectorXd& level,
                       const Eigen::MatrixXd& offsets, const Eigen::VectorXd& kept,
                       const std::function<double(const WarmFit&)>& deviation, WarmFit& fit);

}  // namespace warmjoint::inline identification

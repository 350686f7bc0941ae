// What there is to choose from in an identification: `warmjoint list` prints it, and Python's laws() and identifiers() give it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "identification/options.h"

namespace warmjoint {

/// The laws, and behind them what joins any of them:
/// [{name, equation, parameters[{name, symbol, unit{rotary, linear}, lower, upper, default, meaning}]}].
nlohmann::ordered_json LawsJson();

/// Options in full: [{name, default, allowed, meaning}].
nlohmann::ordered_json OptionsJson(const Options& options);

/// [{name, summary, options[{name, default, allowed, meaning}]}].
nlohmann::ordered_json IdentifiersJson();

/// The measured machines: [{name, machine, kind, source{repository, commit, files, licence}, attach, joints[{name, status, unit, friction[{speed, value,
/// interval95}], fall, halves, message}]}]. friction: at three speeds of the log or fewer, N.m over rad/s, or N over m/s; in A where the log tells no torque. fall: share of
/// the friction that goes when the joint is warm, null where none is known. halves: [{speed, z}] of the fits of both halves of the log.
nlohmann::ordered_json LibraryJson();

}  // namespace warmjoint

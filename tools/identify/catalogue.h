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

}  // namespace warmjoint

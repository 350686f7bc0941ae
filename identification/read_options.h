// What is given for an identifier's options, checked against its own table.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "identification/options.h"
#include "models/foundation/bad_input.h"

namespace warmjoint::inline identification {

/// Throws BadInput from `place` for an unknown name (with the nearest) or a value that is not allowed.
/// Numbers must be finite.
Options ReadOptions(const std::vector<OptionInfo>& table,
                    const std::map<std::string, std::string>& given, const Place& place);

}  // namespace warmjoint::inline identification

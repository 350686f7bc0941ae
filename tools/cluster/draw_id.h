// Names that no two plans share.
#pragma once

#include <string>

namespace warmjoint::inline tools {

/// 16 hexadecimal digits from the system's source of chance.
std::string DrawId();

}  // namespace warmjoint::inline tools

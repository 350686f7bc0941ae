// SHA-256, to tell whether stored bytes are still what they were.
#pragma once

#include <string>
#include <string_view>

namespace warmjoint::inline tools {

/// The digest of FIPS 180-4 as 64 hexadecimal digits.
std::string Sha256(std::string_view bytes);

}  // namespace warmjoint::inline tools

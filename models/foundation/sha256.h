// SHA-256.
#pragma once

#include <string>
#include <string_view>

namespace warmjoint {

/// SHA-256 (FIPS 180-4) of the bytes, 64 hexadecimal digits.
std::string Sha256(std::string_view bytes);

}  // namespace warmjoint

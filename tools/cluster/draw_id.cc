#include "tools/cluster/draw_id.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <cstdint>

namespace warmjoint::inline tools {

std::string DrawId() {
  std::uint64_t bits = 0;
  [[maybe_unused]] const auto drawn = getrandom(&bits, sizeof bits, 0);
  return fmt::format("{:016x}", bits);
}

}  // namespace warmjoint::inline tools

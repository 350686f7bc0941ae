#include "models/foundation/bad_input.h"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>

namespace warmjoint {
namespace {

const char* Remedy(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
      return "make room, or choose a place with more";
    case EFBIG:
      return "raise the limit on the size of files (ulimit -f)";
    case EPIPE:
      return "what read it has ended";
    default:
      return "choose another place";
  }
}

}  // namespace

void FailOutput(const std::string& target, int error) {
  throw OutputFailed(fmt::format("{}: output could not be written: {}; {}", target,
                                 std::generic_category().message(error), Remedy(error)));
}

std::string Version() {
  return fmt::format("{}.{}.{}", WARMJOINT_VERSION_MAJOR, WARMJOINT_VERSION_MINOR,
                     WARMJOINT_VERSION_PATCH);
}

}  // namespace warmjoint

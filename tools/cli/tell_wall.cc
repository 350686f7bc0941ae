#include "tools/cli/tell_wall.h"

#include <fmt/format.h>

#include <utility>

#include "tools/suite/external_command.h"
#include "tools/suite/wall.h"
#include "tools/terminal/say.h"

namespace warmjoint::inline tools {

void TellWall(const std::vector<SuiteIdentifier>& identifiers,
              const std::vector<std::filesystem::path>& secrets) {
  // one sentence on the wall, a warning for each secret that it does not hide
  bool told = false;
  for (const SuiteIdentifier& identifier : identifiers) {
    if (identifier.name != kExternal) continue;
    // that there is none is a warning, which --quiet keeps
    if (BestWall() == WallKind::none) return Say(stderr, "{}\n", WallInWords());
    if (!std::exchange(told, true)) SayNotice("{}\n", WallInWords());
    for (const std::filesystem::path& secret : secrets) {
      if (WallHides(secret, ReadableBy(identifier))) continue;
      Say(stderr, "warning: {} can read {}: it lies where the wall is open; move it\n",
          identifier.label, secret.string());
    }
  }
}

}  // namespace warmjoint::inline tools

#include "tools/cli/tell_run.h"

#include <fmt/format.h>

#include "models/foundation/excerpt.h"
#include "tools/terminal/say.h"

namespace warmjoint::inline tools {

ExitStatus TellEnding(const std::filesystem::path& directory, const RunEnding& ending,
                      RunPart part) {
  Say(stdout, "{}: {}; see: warmjoint compare {}\n", directory.string(), CountsInWords(ending),
      directory.string());
  for (const auto& [label, reason] : ending.silent) {
    Say(stderr, "{} answered in no realization; the first time: {}\n", Excerpt(label),
        Excerpt(reason, kLongestComplaint));
  }
  const bool done = ending.silent.empty() || part == RunPart::shard;
  return done ? ExitStatus::done : ExitStatus::no_answer;
}

void TellNotFollowing(const FollowingTally& following, const RunDescription& description) {
  const std::string words = following.Words(description.variants);
  if (!words.empty()) SayNotice("notice: {}\n", words);
}

}  // namespace warmjoint::inline tools

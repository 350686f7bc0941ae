#include "tools/cli/end_of_run.h"

#include <fmt/format.h>

#include "models/foundation/excerpt.h"
#include "tools/terminal/say.h"

namespace warmjoint {

ExitStatus PrintEnding(const std::filesystem::path& directory, const RunEnding& ending,
                       RunPart part) {
  // how many results there are, and of which kind
  Say(stdout, "{}: {}; see: warmjoint compare {}\n", directory.string(), CountsInWords(ending),
      directory.string());
  // who never answered is told with the first reason
  for (const auto& [label, reason] : ending.silent) {
    Say(stderr, "{} answered in no realization; the first time: {}\n", Excerpt(label),
        Excerpt(reason, kLongestComplaint));
  }

  // a shard may hold too few realizations to say that
  const bool done = ending.silent.empty() || part == RunPart::shard;
  return done ? ExitStatus::done : ExitStatus::no_answer;
}

}  // namespace warmjoint

#include "tools/actions/outputs.h"

#include <algorithm>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"

namespace warmjoint {
namespace fs = std::filesystem;
namespace {

/// Whether both names lead to one file, now or once it is made.
bool AreOne(const fs::path& a, const fs::path& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code ignored;
  if (fs::equivalent(a, b, ignored)) return true;
  if (IsStandardOutput(a) || IsStandardOutput(b)) return IsStandardOutput(a) && IsStandardOutput(b);
  return fs::weakly_canonical(a, ignored) == fs::weakly_canonical(b, ignored);
}

}  // namespace

std::FILE* WordsBeside(const std::vector<fs::path>& outputs) {
  return std::ranges::any_of(outputs, IsStandardOutput) ? stderr : stdout;
}

void KeepApart(const std::vector<fs::path>& outputs, const std::vector<fs::path>& inputs) {
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    // an output that is an input would destroy it
    for (const fs::path& input : inputs) {
      if (IsStandardInput(input) || !AreOne(*output, input)) continue;
      Refuse({output->string()}, "is an input too, which would be lost; choose another output");
    }
    // two outputs in one file would destroy each other
    for (auto other = outputs.begin(); other != output; ++other) {
      if (!AreOne(*output, *other)) continue;
      Refuse({output->string()}, "is given for two outputs; choose another name for one of them");
    }
  }
}

}  // namespace warmjoint

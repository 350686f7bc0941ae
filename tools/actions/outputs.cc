#include "tools/actions/outputs.h"

#include <warmjoint/simulation.h>

#include <algorithm>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/recording/read_recording.h"

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
  const bool taken = std::any_of(outputs.begin(), outputs.end(), IsStandardOutput);
  return taken ? stderr : stdout;
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

const std::vector<std::string>& SimulatedFiles() {
  static const std::vector<std::string> files{"recording.csv", "recording.h5", "truth.json",
                                              "scenario.yaml"};
  return files;
}

void WriteSimulated(const Simulation& recording, const std::string& scenario,
                    const std::string& format, const std::filesystem::path& folder) {
  WriteRecording(recording.measurements, folder / ("recording." + format));
  WriteTruth(recording.truth, folder / "truth.json");
  WriteWholeFile(folder / "scenario.yaml", scenario);
}

}  // namespace warmjoint

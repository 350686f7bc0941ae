#include "tools/actions/simulated_files.h"

#include "models/foundation/atomic_file.h"
#include "models/recording/read_recording.h"
#include "sim/truth/truth_json.h"

namespace warmjoint::inline tools {

const std::vector<std::string>& SimulatedFiles() {
  static const std::vector<std::string> files{"recording.csv", "recording.h5", "truth.json",
                                              "scenario.yaml"};
  return files;
}

void WriteSimulated(const Recording& recording, const std::string& scenario,
                    const std::string& format, const std::filesystem::path& folder) {
  WriteRecording(recording.measurements, folder / ("recording." + format));
  WriteTruth(recording.truth, folder / "truth.json");
  WriteWholeFile(folder / "scenario.yaml", scenario);
}

}  // namespace warmjoint::inline tools

// The files of one simulated recording.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/truth/simulated_recording.h"

namespace warmjoint::inline tools {

/// What a directory of `simulate` may hold: recording.csv or recording.h5, truth.json, scenario.yaml.
const std::vector<std::string>& SimulatedFiles();

/// Writes them into `folder`. scenario: its YAML; format: csv or h5. Throws OutputFailed.
void WriteSimulated(const Recording& recording, const std::string& scenario,
                    const std::string& format, const std::filesystem::path& folder);

}  // namespace warmjoint::inline tools

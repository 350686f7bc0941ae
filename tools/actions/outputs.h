// What commands write, kept apart from what they read and say.
#pragma once

#include <warmjoint/simulation.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace warmjoint {

/// Where a command's words go: stdout, or stderr where one of its outputs is standard output.
std::FILE* WordsBeside(const std::vector<std::filesystem::path>& outputs);

/// Throws BadInput for an output that is one of the inputs, or another output: it would be lost. Names
/// that are empty were not given.
void KeepApart(const std::vector<std::filesystem::path>& outputs,
               const std::vector<std::filesystem::path>& inputs);

/// What a directory of `simulate` may hold: recording.csv or recording.h5, truth.json, scenario.yaml.
const std::vector<std::string>& SimulatedFiles();

/// Writes them into `folder`. scenario: its YAML; format: csv or h5. Throws OutputFailed.
void WriteSimulated(const Simulation& recording, const std::string& scenario,
                    const std::string& format, const std::filesystem::path& folder);

}  // namespace warmjoint

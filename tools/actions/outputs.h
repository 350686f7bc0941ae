// What commands write, kept apart from what they read and say.
#pragma once

#include <cstdio>
#include <filesystem>
#include <vector>

namespace warmjoint {

/// Where a command's words go: stdout, or stderr where one of its outputs is standard output.
std::FILE* WordsBeside(const std::vector<std::filesystem::path>& outputs);

/// Throws BadInput for an output that is one of the inputs, or another output: it would be lost. Names
/// that are empty were not given.
void KeepApart(const std::vector<std::filesystem::path>& outputs,
               const std::vector<std::filesystem::path>& inputs);

}  // namespace warmjoint

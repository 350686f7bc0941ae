// What commands write, kept apart from what they read and say, and written together once all of it is made.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace warmjoint {

/// Where a command's words go: stdout, or stderr where one of its outputs is standard output.
std::FILE* WordsBeside(const std::vector<std::filesystem::path>& outputs);

/// Throws BadInput for an output that is one of the inputs, lies in an input that is a folder and is there already, or is
/// another output: it would be lost. Names that are empty were not given.
void KeepApart(const std::vector<std::filesystem::path>& outputs,
               const std::vector<std::filesystem::path>& inputs);

/// The outputs of one command. What cannot be written is refused before any time is spent, and nothing is written before all
/// of them are made: where one fails, none is there.
class Outputs {
 public:
  /// targets: as they were given, those that are empty were not. inputs: all files that the command reads. Throws as KeepApart, and
  /// BadInput for a target that is no regular file or whose folder cannot be written to.
  Outputs(std::vector<std::filesystem::path> targets, std::vector<std::filesystem::path> inputs);

  /// An input that only another one names. Throws as KeepApart.
  void AddInputs(const std::vector<std::filesystem::path>& inputs);

  /// What goes to `target`, which may be one that was not given: a file in a folder, which is made. Nothing where it is empty.
  /// Throws as the constructor.
  void Add(const std::filesystem::path& target, std::string bytes);

  /// Writes all of them, each whole. Throws OutputFailed.
  void Write();

 private:
  std::vector<std::filesystem::path> targets_, inputs_;
  std::vector<std::pair<std::filesystem::path, std::string>> made_;
};

}  // namespace warmjoint

// Tests of the program in a folder of its own.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "models/foundation/atomic_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {

class InAFolder : public testing::Test {
 protected:
  std::string at(const std::string& name) const { return scratch_.path() / name; }
  std::string File(const std::string& name) const { return ReadWholeFile(at(name)); }
  nlohmann::json JsonFile(const std::string& name) const {
    return nlohmann::json::parse(File(name));
  }

  /// Runs the program there.
  ProgramAnswer Program(const std::vector<std::string>& arguments) const {
    return RunWarmjoint(arguments, {scratch_.path(), {}});
  }

  /// The same where it must end well.
  ProgramAnswer Call(const std::vector<std::string>& arguments) const {
    ProgramAnswer answer = Program(arguments);
    EXPECT_EQ(answer.status, 0) << answer.err;
    return answer;
  }

  /// What it prints as JSON.
  nlohmann::json Json(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--format", "json"});
    return nlohmann::json::parse(Program(arguments).out, nullptr, false);
  }

  const ScratchDirectory scratch_;
};

/// The same, for runs of a suite that a test writes.
class WithASuite : public InAFolder {
 protected:
  std::vector<std::string> Command(const std::string& directory,
                                   const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command{"run", suite_, "-o", at(directory)};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }

  const std::string suite_ = at("little.yaml");
};

}  // namespace warmjoint

// Tests of the program in a folder of its own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
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

  /// The bytes of every file below a folder, by its path in there, databases apart.
  std::map<std::string, std::string> FilesOf(const std::string& folder) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(at(folder))) {
      if (!entry.is_regular_file() || entry.path().extension() == ".sqlite") continue;
      files[std::filesystem::relative(entry.path(), at(folder))] = ReadWholeFile(entry.path());
    }
    return files;
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

  /// What it says where it must refuse.
  std::string Refusal(const std::vector<std::string>& arguments) const {
    const ProgramAnswer answer = Program(arguments);
    EXPECT_EQ(answer.status, 2) << answer.err;
    return answer.err;
  }

  /// What it prints as JSON.
  nlohmann::json Json(const std::vector<std::string>& arguments) const {
    const std::string out = Program(With(arguments, {"--format", "json"})).out;
    return nlohmann::json::parse(out, nullptr, false);
  }

  const ScratchDirectory scratch_;
};

/// The same, for runs of a suite that a test writes.
class WithASuite : public InAFolder {
 protected:
  std::vector<std::string> Command(const std::string& directory,
                                   const std::vector<std::string>& more = {}) const {
    return With({"run", suite_, "-o", at(directory)}, more);
  }

  const std::string suite_ = at("little.yaml");
};

}  // namespace warmjoint

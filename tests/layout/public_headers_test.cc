// What the public interface promises about its headers.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/folders.h"

namespace {

namespace fs = std::filesystem;

std::string TextOf(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// ROOM/include/warmjoint/*.h
std::vector<fs::path> PublicHeaders() {
  std::vector<fs::path> headers;
  for (const char* room : {"models", "scenarios", "sim", "identification", "tools"}) {
    const fs::path folder = warmjoint::test::SourceFolder() / room / "include" / "warmjoint";
    for (const auto& entry : fs::directory_iterator(folder)) headers.push_back(entry.path());
  }
  return headers;
}

TEST(PublicHeaders, IncludeEachOtherTheStandardLibraryEigenAndTheEngineAlone) {
  const std::regex include(R"(^\s*#\s*include\s*(\S+))");
  const std::regex allowed(R"(<(warmjoint/\w+\.h|Eigen/Core|mujoco/mujoco\.h|\w+)>)");
  const std::vector<fs::path> headers = PublicHeaders();
  EXPECT_GE(headers.size(), 10u);
  for (const fs::path& header : headers) {
    std::ifstream stream(header);
    for (std::string line; std::getline(stream, line);) {
      std::smatch match;
      if (!std::regex_search(line, match, include)) continue;
      EXPECT_TRUE(std::regex_match(match[1].str(), allowed)) << header << ": " << line;
    }
  }
}

TEST(PublicHeaders, HaveAProgramInTheReadmeThatIsTested) {
  // each line of the program, indented
  const fs::path root = warmjoint::test::SourceFolder();
  std::istringstream program(TextOf(root / "tests/consumer/main.cc"));
  std::string shown;
  for (std::string line; std::getline(program, line);)
    shown += line.empty() ? "\n" : "    " + line + "\n";
  EXPECT_NE(TextOf(root / "tools/include/README.md").find(shown), std::string::npos);
}

}  // namespace

// What the public interface promises about its headers.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/folders.h"

namespace {

namespace fs = std::filesystem;

const fs::path kInterface = "tools/interface";

std::vector<fs::path> PublicHeaders() {
  std::vector<fs::path> headers;
  const fs::path root = warmjoint::test::SourceFolder() / kInterface / "warmjoint";
  for (const auto& entry : fs::directory_iterator(root)) headers.push_back(entry.path());
  return headers;
}

/// Why a header of the interface may not have this line; empty where it may.
std::string Breach(const std::string& line) {
  std::smatch match;
  static const std::regex include(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  static const std::regex inside(
      R"(\b(Eigen|nlohmann|fmt|YAML|mj[A-Z]\w*|models|scenarios|sim|identification|tools)(::|\b \*))");
  if (std::regex_search(line, match, include)) {
    const std::string header = match[2];
    const bool ours = header.rfind("warmjoint/", 0) == 0;
    const bool standard = header.find_first_of("/.") == std::string::npos;
    return match[1] == "<" && (ours || standard) ? "" : "includes " + header;
  }
  const std::string code = line.substr(0, line.find("//"));
  return std::regex_search(code, match, inside) ? "names " + match.str() : "";
}

TEST(PublicHeaders, IncludeTheStandardLibraryAndEachOtherAlone) {
  const std::vector<fs::path> headers = PublicHeaders();
  EXPECT_GE(headers.size(), 6u);
  EXPECT_LE(headers.size(), 8u);
  for (const fs::path& header : headers) {
    EXPECT_EQ(header.extension(), ".h");
    std::ifstream stream(header);
    for (std::string line; std::getline(stream, line);) {
      EXPECT_EQ(Breach(line), "") << header << ": " << line;
    }
  }
}

TEST(PublicHeaders, KnowWhatIsForbidden) {
  EXPECT_NE(Breach("#include <Eigen/Core>"), "");
  EXPECT_NE(Breach("#include \"models/recording/measurements.h\""), "");
  EXPECT_NE(Breach("#include <nlohmann/json.hpp>"), "");
  EXPECT_NE(Breach("#include <mujoco/mujoco.h>"), "");
  EXPECT_NE(Breach("  Eigen::VectorXd time;"), "");
  EXPECT_NE(Breach("  models::Measurements log;"), "");
  EXPECT_EQ(Breach("#include <vector>"), "");
  EXPECT_EQ(Breach("#include <warmjoint/recording.h>"), "");
  EXPECT_EQ(Breach("  std::vector<double> time;  // of all models"), "");
}

}  // namespace

// The house rules that the #include lines show: arrows go one way, and some rooms may not meet.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/folders.h"

namespace {

namespace fs = std::filesystem;

/// What the files of one room may include. The first room whose folder holds a file is the file's.
struct Room {
  std::string folder;
  std::vector<std::string> may_include;  // folders of the project
  bool may_use_mujoco = false;
};

constexpr const char* kRooms[]{"models", "scenarios", "sim", "identification", "tools"};
constexpr const char* kScore = "identification/include/warmjoint/score.h";

const std::vector<Room>& Rooms() {
  static const std::vector<Room> rooms{
      {"models/include/", {"models/include/"}},
      {"models/foundation/", {"models/include/", "models/foundation/"}},
      {"models/friction/", {"models/include/", "models/foundation/", "models/friction/"}},
      {"models/recording/",
       {"models/include/", "models/foundation/", "models/friction/", "models/recording/"}},
      {"models/", {"models/"}},
      {"scenarios/", {"models/", "scenarios/"}},
      {"sim/include/", {"models/include/", "sim/include/"}, true},
      {"sim/truth/", {"models/", "sim/truth/", "sim/include/"}},
      {"sim/plugin/",
       {"models/include/", "models/foundation/", "models/friction/", "sim/plugin/"},
       true},
      {"sim/", {"models/", "scenarios/", "sim/"}, true},
      {kScore, {"models/include/", "sim/include/", "identification/include/"}},
      {"identification/score/", {"models/", "sim/truth/", "sim/include/", "identification/"}},
      {"identification/", {"models/", "identification/"}},
      {"tools/", {"models/", "scenarios/", "sim/", "identification/", "tools/"}, true},
  };
  return rooms;
}

bool StartsWithAny(const std::string& text, const std::vector<std::string>& starts) {
  return std::ranges::any_of(starts,
                             [&](const std::string& start) { return text.starts_with(start); });
}

/// Why `file` (relative to the project) may not include `header`; empty where it may.
std::string Breach(const std::string& file, const std::string& header) {
  const std::vector<std::string> own{"models/", "scenarios/", "sim/", "identification/", "tools/"};
  for (const Room& room : Rooms()) {
    if (!file.starts_with(room.folder)) continue;

    if (header.starts_with("mujoco/")) return room.may_use_mujoco ? "" : "knows no engine";
    if (!StartsWithAny(header, own)) return "";
    if (!StartsWithAny(header, room.may_include)) return "against the flow of data";

    // identifiers see neither the truth nor the score
    const bool identifies = room.folder == "identification/";
    const bool secret = header.starts_with("identification/score/") || header == kScore;
    return identifies && secret ? "identifiers may not see the score" : "";
  }
  return "stands in no room";
}

/// A public header as a file of its room; any other as it is.
std::string InItsRoom(const std::string& header) {
  for (const std::string room : kRooms) {
    const std::string file = room + "/include/" + header;
    if (header.starts_with("warmjoint/") && fs::exists(warmjoint::test::SourceFolder() / file)) {
      return file;
    }
  }
  return header;
}

/// Headers in the #include lines of a file that begin with one of these brackets: a class of a regular expression.
std::vector<std::string> IncludesOf(const fs::path& path, const std::string& brackets = "[<\"]") {
  std::vector<std::string> headers;
  std::ifstream stream(path);
  const std::regex include(R"(^\s*#\s*include\s*)" + brackets + R"(([^>"]+)[>"])");
  for (std::string line; std::getline(stream, line);) {
    std::smatch match;
    if (std::regex_search(line, match, include)) headers.push_back(match[1]);
  }
  return headers;
}

TEST(IncludeRules, EveryIncludeGoesDownTheFlow) {
  const fs::path root = warmjoint::test::SourceFolder();
  int files = 0;
  for (const std::string folder : kRooms) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".cc" && extension != ".h") continue;
      ++files;
      const std::string file = fs::relative(entry.path(), root);
      for (const std::string& header : IncludesOf(entry.path())) {
        EXPECT_EQ(Breach(file, InItsRoom(header)), "") << file << " includes " << header;
      }
    }
  }
  EXPECT_GT(files, 20) << "the rooms were not found";
}

TEST(IncludeRules, FoldersOfIdentificationIncludeThoseBeforeThem) {
  // the order of the table in identification/README.md
  const std::vector<std::string> order{
      "preparation", "forward", "model",       "uncertainty", "fit",    "linear",      "lagged",
      "inference",   "report",  "warming",     "fields",      "maps",   "alternating", "nonlinear",
      "online",      "holdout", "identifiers", "lack_of_fit", "answer", "robot",       "score"};
  const auto place = [&](const std::string& file) {
    const std::string folder = fs::path(file).parent_path().filename();
    return std::ranges::find(order, folder) - order.begin();
  };
  const fs::path root = warmjoint::test::SourceFolder();
  // a folder that the order does not name would escape it; public headers and sentences have rules of their own
  for (const auto& entry : fs::directory_iterator(root / "identification")) {
    const std::string folder = entry.path().filename();
    if (!entry.is_directory() || folder == "include" || folder == "sentences") continue;
    EXPECT_TRUE(std::ranges::count(order, folder) == 1) << folder << " has no place in the order";
  }
  // the top, which all may include, includes no folder
  for (const auto& entry : fs::directory_iterator(root / "identification")) {
    if (entry.is_directory()) continue;
    for (const std::string& header : IncludesOf(entry.path())) {
      if (!header.starts_with("identification/")) continue;
      EXPECT_EQ(fs::path(header).parent_path(), "identification")
          << entry.path() << " includes " << header;
    }
  }
  for (const std::string& folder : order) {
    for (const auto& entry : fs::directory_iterator(root / "identification" / folder)) {
      const std::string file = fs::relative(entry.path(), root);
      for (const std::string& header : IncludesOf(entry.path())) {
        if (!header.starts_with("identification/") || place(header) == std::ssize(order)) continue;
        EXPECT_LE(place(header), place(file)) << file << " includes " << header;
      }
    }
  }
}

TEST(IncludeRules, SentencesIncludeTheTopOfIdentificationAndRowsAlone) {
  // so that any folder may say something
  const fs::path root = warmjoint::test::SourceFolder();
  int files = 0;
  for (const auto& entry : fs::directory_iterator(root / "identification/sentences")) {
    ++files;
    for (const std::string& header : IncludesOf(entry.path())) {
      const std::string folder = fs::path(header).parent_path();
      const bool allowed = !header.starts_with("identification/") || folder == "identification" ||
                           folder == "identification/sentences" || folder == "identification/fit";
      EXPECT_TRUE(allowed) << entry.path() << " includes " << header;
    }
  }
  EXPECT_GT(files, 10);
}

TEST(IncludeRules, PublicHeadersIncludeEachOtherTheStandardLibraryEigenAndTheEngineAlone) {
  const std::regex allowed(R"(warmjoint/\w+\.h|Eigen/Core|mujoco/mujoco\.h|math\.h|\w+)");
  int headers = 0;
  for (const std::string room : kRooms) {
    const fs::path folder = warmjoint::test::SourceFolder() / room / "include/warmjoint";
    for (const auto& entry : fs::directory_iterator(folder)) {
      ++headers;
      EXPECT_TRUE(IncludesOf(entry.path(), "[\"]").empty())
          << entry.path() << " includes by quotes";
      for (const std::string& header : IncludesOf(entry.path())) {
        EXPECT_TRUE(std::regex_match(header, allowed)) << entry.path() << " includes " << header;
      }
    }
  }
  EXPECT_GE(headers, 10);
}

TEST(IncludeRules, KnowWhatIsForbidden) {
  // one for each sentence of Breach, and what the score alone may include
  EXPECT_NE(Breach("models/friction/law.cc", "mujoco/mujoco.h"), "");
  EXPECT_NE(Breach("models/friction/law.cc", "models/recording/csv.h"), "");
  const std::string identifier = "identification/identifiers/energy_ml.cc";
  EXPECT_NE(Breach(identifier, "sim/include/warmjoint/simulation.h"), "");
  EXPECT_NE(Breach(identifier, "identification/score/npe.h"), "");
  EXPECT_NE(Breach("others/file.cc", "mujoco/mujoco.h"), "");
  EXPECT_EQ(Breach("identification/score/npe.cc", "sim/include/warmjoint/simulation.h"), "");
}

}  // namespace

// The pictures that travel with the sources.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>

#include "models/foundation/atomic_file.h"
#include "tests/support/folders.h"

namespace warmjoint::report {
namespace {

namespace fs = std::filesystem;

TEST(RepositoryPictures, AreTogetherBelowTwoMegabytes) {
  std::uintmax_t bytes = 0;
  int pictures = 0;
  for (const auto& entry : fs::directory_iterator(test::SourceFolder() / "tools/report/pictures")) {
    EXPECT_EQ(entry.path().extension(), ".png") << entry.path();
    bytes += entry.file_size();
    ++pictures;
  }
  EXPECT_GE(pictures, 7) << "the head of README and the gallery";
  EXPECT_LT(bytes, 2000000u);
}

TEST(RepositoryPictures, AreShownInTheReadmeWithWordsForThoseWhoCannotSeeThem) {
  const std::string readme = ReadWholeFile(test::SourceFolder() / "README.md");
  const std::regex picture(R"(!\[([^\]]*)\]\(([^)]*)\))");
  int shown = 0;
  for (std::sregex_iterator it(readme.begin(), readme.end(), picture), end; it != end; ++it) {
    EXPECT_GT((*it)[1].length(), 30) << (*it)[2];
    EXPECT_TRUE(fs::exists(test::SourceFolder() / (*it)[2].str())) << (*it)[2];
    ++shown;
  }
  EXPECT_GE(shown, 1);
}

}  // namespace
}  // namespace warmjoint::report

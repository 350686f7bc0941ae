#include "tools/parser/help.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/terminal/wrap.h"

namespace warmjoint {
namespace {

TEST(Help, PutsWordsInOneColumnWhateverTheHeadIsWrittenIn) {
  CommandNode brew;
  brew.name = "brew";
  OptionNode plain, accented;
  plain.argument = "TEMPERATURE_OF_WATER";
  accented.argument = "TEMPÉRATURE_DE_L'EAU_É";
  plain.description = accented.description = "in degC";
  brew.arguments = {plain, accented};
  std::vector<int> columns;
  for (const std::string& line : Lines(HelpText(brew, "tea", 80))) {
    const std::size_t at = line.find("in degC");
    if (at != std::string::npos) columns.push_back(ShownWidth(line.substr(0, at)));
  }
  EXPECT_THAT(columns, testing::ElementsAre(26, 26));
}

}  // namespace
}  // namespace warmjoint

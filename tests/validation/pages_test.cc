// What pages list: each row of the lists of which a user chooses, or reads in an answer.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "identification/fit/cause.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/lack_of_fit/table.h"
#include "models/foundation/atomic_file.h"
#include "models/friction/laws.h"
#include "models/recording/log_formats.h"
#include "tests/support/folders.h"
#include "tools/actions/run_task.h"

namespace warmjoint {
namespace {

/// Names of a list, and the page that has a word about each.
struct PageOf {
  std::string page;
  std::vector<std::string> names;
};

template <typename List, typename Member>
std::vector<std::string> NamesOf(const List& list, Member member) {
  std::vector<std::string> names;
  for (const auto& one : list) names.emplace_back(one.*member);
  return names;
}

std::vector<PageOf> AllPages() {
  return {{"tools/docs/lack-of-fit.md", NamesOf(LackOfFitTests(), &LackOfFitTest::name)},
          {"tools/docs/trust.md", NamesOf(WordsOf(Source{}), &Word<Source>::name)},
          {"tools/docs/identifiers.md", NamesOf(Identifiers(), &Identifier::name)},
          {"tools/docs/files.md", LawNames()},
          {"tools/docs/formats.md", NamesOf(LogFormats(), &LogFormat::ending)},
          {"scenarios/suites/README.md", SuiteNames()}};
}

TEST(Pages, NameEachRowOfTheirLists) {
  for (const auto& [page, names] : AllPages()) {
    const std::string text = ReadWholeFile(test::SourceFolder() / page);
    EXPECT_FALSE(names.empty()) << page;
    for (const std::string& name : names) {
      // as code or a link, by itself or with options after it; an ending of files in text, too
      const std::string escaped = std::regex_replace(name, std::regex(R"([.])"), R"(\$&)");
      const std::regex named((name.starts_with('.') ? "[`( /]" : "[`[]") + escaped +
                             R"([`,)\] /.])");
      EXPECT_TRUE(std::regex_search(text, named)) << page << " does not name " << name;
    }
  }
}

}  // namespace
}  // namespace warmjoint

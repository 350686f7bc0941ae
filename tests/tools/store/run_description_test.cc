#include "tools/store/run_description.h"

#include <gmock/gmock.h>

#include "models/foundation/bad_input.h"

namespace warmjoint {
namespace {

RunDescription Described(const std::string& yaml) {
  RunDescription description;
  description.suite_yaml = yaml;
  return description;
}

std::string Refusal(const std::string& stored, const std::string& asked) {
  try {
    RefuseDifferentRun(Described(stored), Described(asked), {"R"});
  } catch (const BadInput& refused) {
    return refused.what();
  }
  return "";
}

TEST(RefuseDifferentRun, NamesTheSuitesWhereTheyAreTwo) {
  EXPECT_EQ(Refusal("{name: table1, seed: 1, realizations: 50}", "{name: ladder, seed: 2}"),
            "R: was made by suite table1, and this is ladder; choose another directory");
}

TEST(RefuseDifferentRun, NamesTheFirstEntriesThatDiffer) {
  EXPECT_EQ(Refusal("{name: a, b: 1, c: 1, d: 1}", "{name: a, b: 2, c: 2, d: 2}"),
            "R: holds another run (b: 1 in the directory, 2 asked; c: 1 in the directory, 2 asked; "
            "and 1 more); resume it as it was started or choose another directory");
  EXPECT_EQ(Refusal("{name: a, b: 1}", "{b: 1, name: a}"), "");
}

}  // namespace
}  // namespace warmjoint

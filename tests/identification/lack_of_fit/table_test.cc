// What every row of the table of tests owes.
#include "identification/lack_of_fit/table.h"

#include <gtest/gtest.h>

#include <set>

#include "identification/identifiers/identifier_list.h"
#include "tests/support/judging.h"

namespace warmjoint {
namespace {

TEST(LackOfFitTests, HaveAllThatAnAnswerReads) {
  const Measurements m = test::RecordHour(test::Cold(), 1);
  const Identifier& identifier = FindIdentifier("nominal-ls");
  const PreparedLog log = Prepare(m);
  const IdentifierInput input{log, identifier.options, {}};
  const Fit fit = identifier.fit(input);
  std::set<std::string_view> names;
  for (const LackOfFitTest& test : LackOfFitTests()) {
    SCOPED_TRACE(test.name);
    EXPECT_TRUE(names.insert(test.name).second);
    EXPECT_EQ(FindLackOfFitTest(test.name), &test);
    for (const std::string_view text : {test.words.absent, test.words.question, test.words.advice})
      EXPECT_FALSE(text.empty());
    // made of features over bins, or at samples, as the stage makes it
    const bool over_bins =
        test.stage == Stage::first || test.stage == Stage::hold || test.stage == Stage::last;
    EXPECT_EQ(test.features != nullptr, over_bins);
    EXPECT_EQ(test.at_samples != nullptr, !over_bins);
    // what a reader gets of a finding
    Finding finding;
    finding.test = &test;
    finding.made = finding.rejected = true;
    finding.period = 0.5;
    finding.periods = {0.5};
    finding.lag = 0.1;
    EXPECT_FALSE(test.quantity(finding, input.measurements).empty());
    EXPECT_FALSE(test.remedy({finding, identifier, input, fit}).Text().empty());
  }
}

}  // namespace
}  // namespace warmjoint

#include "identification/options.h"

#include <gmock/gmock.h>

#include "identification/read_options.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

const std::vector<OptionInfo>& Table() {
  static const std::vector<OptionInfo> table{
      {"iterations", "50", "integer >= 0", "steps of the loop"},
      {"fraction", "0.5", "number > 0 <= 1", "share of the samples"},
      {"gain_range", "-9:0", "range", "where the first gain is drawn"},
      {"start", "options", "options|guess|random", "where the loop starts"},
  };
  return table;
}

Options Given(const std::map<std::string, std::string>& given) {
  return ReadOptions(Table(), given, {"suite.yaml", 7});
}

std::string Refusal(const std::string& name, const std::string& value) {
  try {
    Given({{name, value}});
  } catch (const BadInput& refusal) {
    return refusal.what();
  }
  return "accepted";
}

TEST(Options, FillInTheDefaults) {
  const Options options = Given({});
  EXPECT_EQ(options.Integer("iterations"), 50);
  EXPECT_EQ(options.Number("fraction"), 0.5);
  EXPECT_EQ(options.Range("gain_range"), std::pair(-9.0, 0.0));
  EXPECT_EQ(options.Text("start"), "options");
}

TEST(Options, TakeWhatIsGiven) {
  const Options options =
      Given({{"iterations", "0"}, {"gain_range", "-1e2:2.5"}, {"start", "guess"}});
  EXPECT_EQ(options.Integer("iterations"), 0);
  EXPECT_EQ(options.Range("gain_range"), std::pair(-100.0, 2.5));
  EXPECT_EQ(options.Text("start"), "guess");
}

TEST(Options, RefuseAnUnknownNameWithTheNearest) {
  const std::string message = Refusal("iteration", "3");
  EXPECT_THAT(message, HasSubstr("suite.yaml:7: "));
  EXPECT_THAT(message, HasSubstr("'iteration'"));
  EXPECT_THAT(message, HasSubstr("did you mean 'iterations'?"));
  EXPECT_THROW(ReadOptions({}, {{"law", "coulomb"}}, {}), BadInput);
}

TEST(Options, RefuseAWordThatIsNotAllowedWithTheNearest) {
  EXPECT_THAT(Refusal("start", "gues"), HasSubstr("did you mean 'guess'?"));
}

TEST(Options, RefuseWhatIsNoFiniteNumber) {
  for (const char* value : {"", "five", "5x", "nan", "inf"}) {
    EXPECT_THAT(Refusal("fraction", value), HasSubstr(std::string("'") + value + "'"));
  }
  EXPECT_THAT(Refusal("iterations", "2.5"), HasSubstr("integer >= 0"));
  EXPECT_THAT(Refusal("iterations", "3000000000"), HasSubstr("3000000000"));
}

TEST(Options, RefuseNumbersBeyondTheirBounds) {
  EXPECT_EQ(Refusal("fraction", "1"), "accepted");
  EXPECT_THAT(Refusal("fraction", "0"), HasSubstr("number > 0 <= 1"));
  EXPECT_THAT(Refusal("fraction", "1.01"), HasSubstr("number > 0 <= 1"));
  EXPECT_THAT(Refusal("iterations", "-1"), HasSubstr("integer >= 0"));
}

TEST(Options, RefuseRangesThatAreNone) {
  for (const char* value : {"5", "1:0", "a:b", ":", "1:", "0:inf"}) {
    EXPECT_THAT(Refusal("gain_range", value), HasSubstr("lower:upper")) << value;
  }
}

}  // namespace
}  // namespace warmjoint

#include "identification/options.h"

#include <gmock/gmock.h>

#include <array>
#include <typeinfo>

#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

enum class Start { options, guess, random };
std::span<const Word<Start>> WordsOf(Start) {
  static constexpr std::array words{Word{"options", Start::options}, Word{"guess", Start::guess},
                                    Word{"random", Start::random}};
  return words;
}

struct LoopOptions {
  int iterations = 50;
  Start start = Start::options;
  OptionRange gain_range{-9, 0};

  template <class A>
  void Serialize(A* a) {
    a->Field("iterations", &iterations, {.bounds = {.at_least = 0}, .meaning = "of the loop"});
    a->Field("start", &start, {.meaning = "where it starts"});
    a->Field("gain_range", &gain_range, {.meaning = "where the first gain is drawn"});
  }
};

struct ShareOption {
  double fraction = 0.5;

  template <class A>
  void Serialize(A* a) {
    a->Field("fraction", &fraction,
             {.bounds = {.above = 0, .at_most = 1}, .meaning = "share of the samples"});
  }
};

const Options kDefaults = OptionGroups<ShareOption, LoopOptions>{};

Options Read(const std::map<std::string, std::string>& given) {
  return kDefaults.Read(given, {"suite.yaml", 7});
}

TEST(Options, AreListedGroupByGroup) {
  std::vector<std::vector<std::string>> rows;
  for (const OptionInfo& one : kDefaults.List()) {
    rows.push_back({one.name, one.value, one.allowed, one.meaning});
  }
  EXPECT_THAT(
      rows,
      ElementsAre(ElementsAre("fraction", "0.5", "number > 0 <= 1", "share of the samples"),
                  ElementsAre("iterations", "50", "integer >= 0", "of the loop"),
                  ElementsAre("start", "options", "options|guess|random", "where it starts"),
                  ElementsAre("gain_range", "-9:0", "range", "where the first gain is drawn")));
}

TEST(Options, AreReadAndToldWhereTheyAreNotAtTheirDefault) {
  const Options options = Read(
      {{"fraction", "1"}, {"iterations", "50"}, {"gain_range", "-1e2:2.5"}, {"start", "guess"}});
  EXPECT_EQ(options.Get<ShareOption>().fraction, 1);
  EXPECT_EQ(options.Get<LoopOptions>().start, Start::guess);
  EXPECT_EQ(options.Get<LoopOptions>().gain_range.lower, -100);
  EXPECT_THAT(options.Changed(), ElementsAre(Pair("fraction", "1"), Pair("gain_range", "-100:2.5"),
                                             Pair("start", "guess")));
  EXPECT_TRUE(kDefaults.Changed().empty());
}

TEST(Options, HaveAGroupOrNot) {
  const Options options = kDefaults.With(ShareOption{0.1});
  EXPECT_EQ(options.Get<ShareOption>().fraction, 0.1);
  EXPECT_EQ(kDefaults.Get<ShareOption>().fraction, 0.5);
  EXPECT_FALSE(Options().Find<ShareOption>());
  EXPECT_THROW(Options().Get<ShareOption>(), std::bad_cast);
  EXPECT_TRUE(options.Has("start"));
  EXPECT_FALSE(Options().Has("start"));
}

TEST(Options, AreRefusedWithPlaceNameAndValue) {
  // what is given, and what the refusal must name besides
  const std::vector<std::array<const char*, 3>> wrong{
      {"iteration", "3", "did you mean 'iterations'?"},
      {"start", "gues", "did you mean 'guess'?"},
      {"fraction", "", "above 0 and of at most 1"},
      {"fraction", "five", "above 0 and of at most 1"},
      {"fraction", "5x", "above 0 and of at most 1"},
      {"fraction", "nan", "above 0 and of at most 1"},
      {"fraction", "inf", "above 0 and of at most 1"},
      {"fraction", "0", "above 0 and of at most 1"},
      {"fraction", "1.01", "above 0 and of at most 1"},
      {"iterations", "2.5", "whole number from 0"},
      {"iterations", "-1", "whole number from 0"},
      {"iterations", "3000000000", "whole number from 0"},
      {"gain_range", "5", "lower:upper"},
      {"gain_range", "1:0", "lower:upper"},
      {"gain_range", "a:b", "lower:upper"},
      {"gain_range", ":", "lower:upper"},
      {"gain_range", "0:inf", "lower:upper"},
  };
  for (const auto& row : wrong) {
    const std::string name = row[0], value = row[1];
    const std::string refusal = test::RefusalOf([&] { Read({{name, value}}); });
    EXPECT_THAT(refusal, AllOf(HasSubstr("suite.yaml:7: "), HasSubstr(name), HasSubstr(row[2])))
        << name << '=' << value;
    if (name != "iteration") {
      EXPECT_THAT(refusal, HasSubstr("'" + value + "'"));
    }
  }
}

}  // namespace
}  // namespace warmjoint

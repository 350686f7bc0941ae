// Which identifiers a run takes, by what is typed.
#include "tools/suite/prepare_identifiers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/foundation/bad_input.h"

namespace warmjoint {
namespace {

using testing::ElementsAre;

/// A suite of three: one identifier by two sets of options, and another.
const std::vector<SuiteIdentifier>& OfSuite() {
  static const std::vector<SuiteIdentifier> all{{"energy-als", "short", {{"iterations", "5"}}, {}},
                                                {"energy-als", "long", {{"iterations", "9"}}, {}},
                                                {"nominal-ls", "nominal-ls", {}, {}}};
  return all;
}

std::vector<std::string> Labels(const std::vector<std::string>& names,
                                const std::vector<SuiteIdentifier>& suite = OfSuite()) {
  std::vector<std::string> labels;
  for (const SuiteIdentifier& one : ChooseIdentifiers(suite, names)) labels.push_back(one.label);
  return labels;
}

TEST(ChooseIdentifiers, TakesAllOfASuiteUnlessSomeAreNamed) {
  EXPECT_THAT(Labels({}), ElementsAre("short", "long", "nominal-ls"));
  EXPECT_THAT(Labels({"nominal-ls", "long"}), ElementsAre("nominal-ls", "long"));
  EXPECT_THAT(Labels({"energy-als"}), ElementsAre("short", "long"));
  EXPECT_THAT(Labels({"long", "energy-als"}), ElementsAre("long", "short")) << "each once";
}

TEST(ChooseIdentifiers, AddsToThem) {
  EXPECT_THAT(Labels({"+energy-ml"}), ElementsAre("short", "long", "nominal-ls", "energy-ml"));
  EXPECT_THAT(Labels({"+energy-ml", "long"}), ElementsAre("energy-ml", "long"));
}

TEST(ChooseIdentifiers, KnowsAnEarlierNameOnEitherSide) {
  EXPECT_THAT(Labels({"energy-em"}), ElementsAre("short", "long"));
  EXPECT_THAT(Labels({"energy-als"}, {{"energy-em", "old", {}, {}}}), ElementsAre("old"));

  // one that the suite lacks is that of the list, by its name of now
  const auto chosen = ChooseIdentifiers({}, {"energy-em"});
  ASSERT_EQ(chosen.size(), 1u);
  EXPECT_EQ(chosen[0].name, "energy-als");
  EXPECT_EQ(chosen[0].label, "energy-em") << "as it was asked for";
}

TEST(ChooseIdentifiers, RefusesWhatNobodyIsCalledAndALabelTwice) {
  EXPECT_THROW(Labels({"nominal-sl"}), BadInput);
  EXPECT_THROW(Labels({"mine=cat {recording}", "mine=cat {recording}"}), BadInput);
}

}  // namespace
}  // namespace warmjoint

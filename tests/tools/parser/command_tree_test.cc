#include "tools/parser/command_tree.h"

#include <gmock/gmock.h>

#include "tests/tools/parser/example_tree.h"

namespace warmjoint {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const OptionNode& Option(const CommandNode& command, const std::string& name) {
  for (const OptionNode& option : command.options) {
    if (option.names.back() == name) return option;
  }
  throw std::out_of_range(name);
}

TEST(CommandTree, HoldsWhatTheParserKnows) {
  const ExampleParser parser;
  const CommandNode tree = ReadTree(parser.app);
  EXPECT_EQ(tree.name, "warmjoint");
  ASSERT_EQ(tree.commands.size(), 2u);
  const CommandNode& brew = tree.commands[0];
  EXPECT_EQ(brew.name, "brew");

  ASSERT_EQ(brew.arguments.size(), 2u);
  EXPECT_EQ(brew.arguments[0].argument, "KIND");
  EXPECT_TRUE(brew.arguments[0].required);
  EXPECT_FALSE(brew.arguments[0].repeatable);
  EXPECT_THAT(brew.arguments[0].Choices(), ElementsAre("tea", "coffee"));
  EXPECT_TRUE(brew.arguments[1].repeatable);
  EXPECT_EQ(brew.arguments[1].description, "cups to fill");

  const OptionNode& size = Option(brew, "--size");
  EXPECT_THAT(size.Choices(), ElementsAre("small", "large"));
  EXPECT_EQ(size.initial, "small");
  const OptionNode& output = Option(brew, "--output");
  EXPECT_THAT(output.names, ElementsAre("-o", "--output"));
  EXPECT_EQ(output.value, "FILE");
  EXPECT_TRUE(output.required);
  EXPECT_THAT(output.Choices(), IsEmpty());
  const OptionNode& hot = Option(brew, "--hot");
  EXPECT_FALSE(hot.takes_value());
  EXPECT_EQ(hot.group, "Heat");
}

TEST(CommandTree, NamesInItsUsageWhatMustBeGiven) {
  const ExampleParser parser;
  const CommandNode tree = ReadTree(parser.app);
  EXPECT_EQ(UsageOf(tree, ""), "warmjoint COMMAND [OPTIONS]");
  EXPECT_EQ(UsageOf(tree.commands[0], "warmjoint"),
            "warmjoint brew KIND [CUP...] -o FILE [OPTIONS]");
}

}  // namespace
}  // namespace warmjoint

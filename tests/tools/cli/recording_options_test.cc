#include "tools/cli/recording_options.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "models/foundation/serialize.h"

namespace warmjoint {
namespace {

/// What a command takes from these words.
RecordingSource Parsed(std::vector<std::string> words) {
  CLI::App parser;
  RecordingSource arguments;
  AddRecordingOptions(parser, arguments);
  AddHoldOptions(parser, arguments.prepare);
  std::reverse(words.begin(), words.end());  // as CLI11 takes them
  parser.parse(words);
  return arguments;
}

TEST(RecordingOptions, AreTypedAsTheyWereRead) {
  const std::vector<std::string> typed{
      "a log.csv", "b.csv",          "--map",           "time=t_s",
      "--map",     "torque=force N", "--unit",          "position=deg",
      "--scale",   "torque=-1",      "--wrap",          "25",
      "--joint",   "linear",         "--gear",          "1256.6370614359173",
      "--trim",    "0.15",           "--shortest-hold", "0.5"};
  const RecordingSource once = Parsed(typed);
  EXPECT_EQ(WordsOf(once), typed);
  EXPECT_EQ(WriteFields(Parsed(WordsOf(once))), WriteFields(once));
}

TEST(RecordingOptions, AtTheirDefaultsAreLeftOut) {
  EXPECT_EQ(WordsOf(Parsed({"log.csv"})), std::vector<std::string>{"log.csv"});
}

}  // namespace
}  // namespace warmjoint

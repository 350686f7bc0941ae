#include "models/foundation/read_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace warmjoint {
namespace {

using testing::HasSubstr;

/// What refuses the text.
std::string Refusal(const std::string& text) {
  try {
    ParseJson(text, "e.json");
  } catch (const BadInput& refusal) {
    return refusal.what();
  }
  return "";
}

TEST(ParseJson, NamesFileAndLineOfWhatIsNoJson) {
  EXPECT_THAT(Refusal("{\n\"a\": 1,\n}"), HasSubstr("e.json:3: is not JSON"));
  EXPECT_THAT(Refusal(""), HasSubstr("e.json:1: is not JSON"));
}

TEST(ParseJson, NamesTheNumberThatNoDoubleHolds) {
  EXPECT_THAT(Refusal("{\"a\":\n 1e999}"), HasSubstr("e.json:2: 1e999 is beyond the largest"));
  EXPECT_THAT(Refusal("[-" + std::string(400, '9') + "]"), HasSubstr("e.json:1: -999"));
}

TEST(ParseJson, RefusesWhatIsNoUtf8) {
  EXPECT_THAT(Refusal("{\"a\":\n \"\xCF\"}"), HasSubstr("e.json:2: byte 9 is not UTF-8"));
  EXPECT_THAT(Refusal(std::string("{}\0", 3)), HasSubstr("byte 3"));
}

TEST(ParseJson, BoundsTheDepthAndNotBracketsInText) {
  const auto nested = [](int depth) {
    const auto n = static_cast<std::size_t>(depth);
    return std::string(n, '[') + std::string(n, ']');
  };
  EXPECT_EQ(Refusal(nested(kDeepestJson)), "");
  EXPECT_THAT(Refusal(nested(kDeepestJson + 1)), HasSubstr("deeper than 64 levels"));
  EXPECT_THAT(Refusal(std::string(10'000'000, '[')), HasSubstr("deeper than 64 levels"));
  EXPECT_EQ(Refusal("[\"" + std::string(100, '[') + "\\\"" + std::string(100, '{') + "\"]"), "");
}

}  // namespace
}  // namespace warmjoint

#include "models/foundation/read_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

std::string Refusal(const std::string& text) {
  return test::RefusalOf([&] { ParseJson(text, "e.json"); });
}

TEST(ParseJson, NamesFileAndLineOfWhatItRefuses) {
  test::ExpectRefused({{"{\n\"a\": 1,\n}", "e.json:3: ", "JSON"},
                       {"", "e.json:1: ", "JSON"},
                       {"{\"a\":\n 1e999}", "e.json:2: ", "1e999"},
                       {"[-" + std::string(400, '9') + "]", "e.json:1: ", "-999"},
                       {"{\"a\":\n \"\xCF\"}", "e.json:2: ", "byte 9"},
                       {std::string("{}\0", 3), "e.json", "byte 3"}},
                      [](const std::string& text) { ParseJson(text, "e.json"); });
}

TEST(ParseJson, BoundsTheDepthAndNotBracketsInText) {
  const auto nested = [](int depth) {
    const auto n = static_cast<std::size_t>(depth);
    return std::string(n, '[') + std::string(n, ']');
  };
  EXPECT_EQ(Refusal(nested(kDeepestJson)), "accepted");
  EXPECT_THAT(Refusal(nested(kDeepestJson + 1)), HasSubstr("deeper than 64 levels"));
  EXPECT_THAT(Refusal(std::string(10'000'000, '[')), HasSubstr("deeper than 64 levels"));
  EXPECT_EQ(Refusal("[\"" + std::string(100, '[') + "\\\"" + std::string(100, '{') + "\"]"),
            "accepted");
}

}  // namespace
}  // namespace warmjoint

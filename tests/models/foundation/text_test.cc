// Numbers, names, JSON and XML as text, and what may be shown of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "models/foundation/excerpt.h"
#include "models/foundation/node.h"
#include "models/foundation/parse_number.h"
#include "models/foundation/sha256.h"
#include "models/foundation/xml_tags.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Utf8, FindsTheFirstByteThatIsNone) {
  EXPECT_FALSE(FirstBrokenByte("a\u00e4\u4e2d\U0001F600"));
  EXPECT_EQ(FirstBrokenByte("ab\xCF"), 2u) << "cut off";
  EXPECT_EQ(FirstBrokenByte("\x80"), 0u) << "goes on with nothing";
  EXPECT_EQ(FirstBrokenByte("a\xC0\xAF"), 1u) << "longer than need be";
  EXPECT_EQ(FirstBrokenByte("\xED\xA0\x80"), 0u) << "half of a pair";
  EXPECT_EQ(FirstBrokenByte(std::string_view("a\0b", 3)), 1u) << "a zero byte";
}

TEST(Excerpt, CutsLongTextAfter60CharactersAndNoneInTwo) {
  EXPECT_EQ(Excerpt(""), "");
  EXPECT_EQ(Excerpt(std::string(60, 'a')), std::string(60, 'a'));
  EXPECT_EQ(Excerpt(std::string(61, 'a')), std::string(60, 'a') + "...");
  std::string umlauts;
  for (int i = 0; i < 70; ++i) umlauts += "ä";
  EXPECT_EQ(Excerpt(umlauts), umlauts.substr(0, 120) + "...");
  EXPECT_LE(Excerpt(std::string(1000, '\x80')).size(), 243u) << "bytes that are no text";
}

TEST(Excerpt, ShowsAsCodesWhatControlsTheTerminalOrIsNoText) {
  EXPECT_EQ(Excerpt(std::string_view("a\x1b[31m\n\0b", 9)), "a\\x1B[31m\\x0A\\x00b");
  EXPECT_EQ(Excerpt("\u009b31m"), "\\u009B31m") << "one character that is CSI to some terminals";
  EXPECT_EQ(Excerpt("gpj.\u202Egnp"), "gpj.\\u202Egnp") << "turns the writing round";
  EXPECT_EQ(Excerpt("\u2066x\u2069\u2028"), "\\u2066x\\u2069\\u2028");
  // bytes that are no text
  EXPECT_EQ(Excerpt("\xCF"), "\\xCF");
  EXPECT_EQ(Excerpt("a\xC0\x80z"), "a\\xC0\\x80z") << "a zero, longer than need be";
  EXPECT_EQ(Excerpt("\xED\xA0\x80"), "\\xED\\xA0\\x80") << "half of a pair";
  EXPECT_EQ(Excerpt("\xF4\x90\x80\x80"), "\\xF4\\x90\\x80\\x80") << "beyond the last character";
  EXPECT_EQ(Excerpt("a\u00e4\u4e2d\U0010FFFF"), "a\u00e4\u4e2d\U0010FFFF") << "is text";
}

TEST(ExcerptOfList, CountsWhatItLeavesOut) {
  EXPECT_EQ(ExcerptOfList({"time", "torque"}), "time, torque");
  const std::string many = ExcerptOfList(std::vector<std::string>(1000, "c"));
  EXPECT_EQ(many.substr(many.size() - 17), "c, c and 976 more");
}

TEST(EditDistance, CountsEachKindOfSlipOnce) {
  EXPECT_EQ(EditDistance("speeds", "speeds"), 0);
  EXPECT_EQ(EditDistance("speds", "speeds"), 1);
  EXPECT_EQ(EditDistance("speedss", "speeds"), 1);
  EXPECT_EQ(EditDistance("spaeds", "speeds"), 1);
  EXPECT_EQ(EditDistance("sepeds", "speeds"), 1);
  EXPECT_EQ(EditDistance("", "abc"), 3);
}

TEST(Suggestion, NamesTheNearestAndStaysSilentAboutStrangers) {
  EXPECT_EQ(Suggestion("viscos", {"coulomb", "viscous"}),
            "; did you mean 'viscous'? Known: coulomb, viscous");
  EXPECT_EQ(Suggestion("temperature", {"coulomb", "viscous"}), "; known: coulomb, viscous");
  EXPECT_EQ(Suggestion("anything", {}), "");
}

TEST(ParseNumber, ReadsWholeNumbersFractionsAndExponents) {
  EXPECT_EQ(ParseNumber("5"), 5.0);
  EXPECT_EQ(ParseNumber(" -2.5e-3\t"), -2.5e-3);
  EXPECT_EQ(ParseNumber("+1"), 1.0);
  EXPECT_TRUE(std::isnan(*ParseNumber("nan")));
  EXPECT_EQ(ParseNumber("inf"), std::numeric_limits<double>::infinity());
  // what is too small becomes what is next to it
  EXPECT_EQ(ParseNumber("1e-400"), 0.0);
  EXPECT_EQ(ParseNumber("-1e-400"), -0.0);
  EXPECT_EQ(ParseNumber("1e-310"), 1e-310) << "denormal";
}

TEST(ParseNumber, RefusesWhatIsLeftOver) {
  for (const char* text :
       {"", " ", "5x", "5 6", "1,5", "--1", "+-1", "0x10", "1e999", "-1e400", "five"}) {
    EXPECT_FALSE(ParseNumber(text).has_value()) << '\'' << text << '\'';
  }
}

TEST(ParseUnsignedAndInteger, RefuseFractionsAndDoNotWrapRound) {
  EXPECT_EQ(ParseUnsigned("18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
  for (const char* text : {"-1", "18446744073709551616", "1.5", "1e3", ""}) {
    EXPECT_FALSE(ParseUnsigned(text).has_value()) << '\'' << text << '\'';
  }
  EXPECT_EQ(ParseInteger("-42"), -42);
  for (const char* text : {"1.5", "1e3", "9223372036854775808", ""}) {
    EXPECT_FALSE(ParseInteger(text).has_value()) << '\'' << text << '\'';
  }
}

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

std::vector<std::string> Names(std::string_view text) {
  std::vector<std::string> names;
  XmlTagReader reader(text);
  while (const auto tag = reader.Next()) {
    static constexpr const char* marks[]{"", "/", "."};
    names.push_back(marks[static_cast<int>(tag->kind)] + std::string(tag->name));
  }
  return names;
}

TEST(XmlTags, ComeInOrderWithTheirKindUntilTheTextEnds) {
  EXPECT_THAT(Names("<a><b x='1'/>text</a>"), ElementsAre("a", ".b", "/a"));
  // what is no tag
  EXPECT_THAT(Names("<?xml v='<a>'?><!DOCTYPE a><!-- <b> --><![CDATA[<c>]]><d/>"),
              ElementsAre(".d"));
  // broken text
  EXPECT_THAT(Names(""), IsEmpty());
  EXPECT_THAT(Names("<!-- never closed <a>"), IsEmpty());
  EXPECT_THAT(Names("<a b='never closed><c>"), ElementsAre("a"));
  EXPECT_THAT(Names("<"), ElementsAre(""));
  EXPECT_THAT(Names("<>"), ElementsAre(""));
}

TEST(XmlTags, KnowTheirLineAndAttributes) {
  XmlTagReader reader("\n\n<a one = \"1 > 0\"\n two='2'/>\n<b/>");
  const auto a = reader.Next();
  ASSERT_TRUE(a);
  EXPECT_EQ(a->line, 3);
  EXPECT_EQ(a->Attribute("one"), "1 > 0");
  EXPECT_EQ(a->Attribute("two"), "2");
  EXPECT_EQ(a->Attribute("wo"), std::nullopt);
  const auto b = reader.Next();
  ASSERT_TRUE(b);
  EXPECT_EQ(b->line, 5);
}

// examples of NIST for FIPS 180-4: one block, two blocks, and a million of them
TEST(Sha256, AgreesWithTheStandardsExamples) {
  EXPECT_EQ(Sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(Sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(Sha256(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

}  // namespace
}  // namespace warmjoint

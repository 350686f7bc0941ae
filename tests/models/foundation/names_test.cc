// Names from outside are text, or refused where they enter; descriptions of robots, before a parser sees them.
#include "models/foundation/names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>

#include "models/foundation/atomic_file.h"
#include "models/foundation/description_text.h"
#include "models/foundation/node.h"
#include "models/foundation/xml_tags.h"
#include "tests/support/refusal.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

TEST(Names, AreText) {
  for (const char* good : {"elbow", "a/b_1.2", "Gelenk \xC3\xA4", "\xF0\x9F\x98\x80", ""}) {
    RequireName("the name of a joint", good, {"r.urdf"});
  }
  const std::pair<const char*, const char*> bad[]{
      {"a\nb", "\\x0A at its byte 2"},         {"\x1B[31m", "\\x1B at its byte 1"},
      {"ab\x7F", "\\x7F at its byte 3"},       {"a\xE2\x80\xAEz", "\\u202E at its byte 2"},
      {"\xEF\xBF\xBE", "\\uFFFE at its byte"}, {"caf\xE9", "no UTF-8 at its byte 4"}};
  for (const auto& [name, words] : bad) {
    EXPECT_THAT(test::RefusalOf([&] {
                  RequireName("the name of a joint", name, {"r.urdf", 7});
                }),
                AllOf(HasSubstr("r.urdf:7: the name of a joint '"), HasSubstr(words)));
  }
}

TEST(Names, HaveAnEnd) {
  RequireName("the name of a joint", std::string(200, 'x'), {"r.urdf"});
  EXPECT_THAT(test::RefusalOf([] {
                RequireName("the name of a joint", std::string(201, 'x'), {"r.urdf", 7});
              }),
              AllOf(HasSubstr("r.urdf:7: "), HasSubstr("has 201 bytes; at most 200")));
}

TEST(Names, TextsMayHaveLines) {
  RequireText("the text", "two\nlines\tand \xE2\x80\x8F marks", {"e.json"});
  EXPECT_THAT(test::RefusalOf([] { RequireText("the text", "\x1B[2J", {"e.json"}); }),
              HasSubstr("\\x1B"));
}

TEST(Names, OfJsonAreRefusedWithTheirFile) {
  EXPECT_THAT(test::RefusalOf([] { ParseJson(R"({"joints": {"a\nb": {}}})", "robot.json"); }),
              AllOf(HasSubstr("robot.json: the key 'a"), HasSubstr("\\x0A at its byte 2")));
  EXPECT_THAT(test::RefusalOf([] { ParseJson(R"({"unit": "N.m\u001b"})", "e.json"); }),
              AllOf(HasSubstr("'unit'"), HasSubstr("\\x1B")));
  EXPECT_EQ(ParseJson(R"({"message": "a\nb"})", "e.json")["message"], "a\nb");
}

TEST(Names, InXmlAreOfItsCharacters) {
  EXPECT_EQ(EscapeXml("a<b>&\"\n\x01"), "a&lt;b&gt;&amp;&quot;\\x0A\\x01");
}

class DescriptionText : public testing::Test {
 protected:
  fs::path File(const std::string& name, const std::string& text) const {
    WriteWholeFile(scratch_.path() / name, text);
    return scratch_.path() / name;
  }
  std::string RefusalOf(const std::string& text) const {
    const fs::path file = File("r.xml", text);
    return test::RefusalOf([&] { ReadDescription(file); });
  }
  static std::string Urdf(const std::string& mass, const std::string& more = "") {
    return "<robot name='r'>\n<link name='upper'><inertial><mass value=\"" + mass +
           "\"/></inertial></link>\n" + more + "</robot>";
  }

  const ScratchDirectory scratch_;
};

TEST_F(DescriptionText, NumbersOfAUrdfAreNumbersByLinkAndValue) {
  for (const char* mass : {"nan", "inf", "-1", "x", "1,5", "", "1e300", "1 2"}) {
    EXPECT_THAT(RefusalOf(Urdf(mass)),
                AllOf(HasSubstr("r.xml:2: "), HasSubstr(std::string("'") + mass + "'")));
  }
  EXPECT_THAT(RefusalOf(Urdf("-1")), AllOf(HasSubstr("'upper'"), HasSubstr("0 or more, kg")));
  const auto limit = [](const std::string& attributes) {
    return Urdf("1", "<joint name='j'><limit " + attributes + "/></joint>");
  };
  EXPECT_THAT(RefusalOf(limit("effort=\"-1\"")),
              AllOf(HasSubstr("joint 'j'"), HasSubstr("effort")));
  EXPECT_THAT(RefusalOf(limit("upper=\"1,5\"")), HasSubstr("upper of <limit>"));
  // what is right, and an infinite limit, which is none; elsewhere these words mean what they like
  for (const std::string& good : {Urdf("0"), Urdf("+1.5"), Urdf(" 2e0 "),
                                  limit("lower=\"-inf\" upper=\"inf\" effort=\"1e308\""),
                                  Urdf("1", "<gazebo><mass value=\"heavy\"/></gazebo>")}) {
    ReadDescription(File("r.xml", good));
  }
}

TEST_F(DescriptionText, WhatHasNoEndIsRefusedBeforeItIsMade) {
  EXPECT_THAT(RefusalOf("<mujoco><worldbody><replicate count=\"100000000\"/></worldbody></mujoco>"),
              HasSubstr("<replicate> makes more than"));
  EXPECT_THAT(RefusalOf("<mujoco><replicate count=\"1000\"><replicate count=\"1000\"><geom/>"
                        "</replicate></replicate></mujoco>"),
              HasSubstr("makes more than"));
  EXPECT_THAT(RefusalOf("<mujoco><size nuserdata=\"1e8\"/></mujoco>"), HasSubstr("nuserdata"));
  EXPECT_THAT(RefusalOf("<mujoco><hfield nrow=\"100000\" ncol=\"100000\"/></mujoco>"),
              HasSubstr("1e+10 numbers"));
  EXPECT_THAT(RefusalOf("<mujoco>\n<geom mass=\"nan\"/></mujoco>"),
              AllOf(HasSubstr("r.xml:2: "), HasSubstr("mass of <geom>")));
  ReadDescription(File("r.xml",
                       "<mujoco><replicate count=\"20\"><geom name=\"inf\"/></replicate>"
                       "<joint range=\"-inf inf\"/></mujoco>"));
}

TEST_F(DescriptionText, FilesAreFoundWhereverANameMayLead) {
  fs::create_directory(scratch_.path() / "parts");
  File("parts/link.stl", "solid");
  File("parts/body.xml", "<mujocoinclude><mesh file=\"link.stl\"/></mujocoinclude>");
  const fs::path model = File(
      "m.xml", "<mujoco><compiler meshdir=\"parts\"/><include file=\"parts/body.xml\"/></mujoco>");
  std::vector<std::string> names;
  for (const fs::path& file : FilesOfDescription(model)) names.push_back(file.filename());
  EXPECT_THAT(names, ElementsAre("m.xml", "body.xml", "link.stl"));
}

TEST_F(DescriptionText, APipeIsNoFile) {
  ASSERT_EQ(mkfifo((scratch_.path() / "pipe").c_str(), 0600), 0);
  for (const char* element : {"<include file=\"pipe\"/>", "<mesh file=\"pipe\"/>",
                              "<texture fileright=\"pipe\"/>", "<model file=\"pipe\"/>"}) {
    EXPECT_THAT(RefusalOf(std::string("<mujoco>") + element + "</mujoco>"),
                AllOf(HasSubstr("a pipe"), HasSubstr("r.xml:1")));
  }
}

}  // namespace
}  // namespace warmjoint

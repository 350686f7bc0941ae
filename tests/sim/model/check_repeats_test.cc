#include "sim/model/check_repeats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/foundation/bad_input.h"
#include "sim/model/load_model.h"
#include "tests/models/recording/temporary_file.h"

namespace warmjoint {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::string Model(const std::string& world) {
  return "<mujoco>\n<worldbody>\n" + world + "\n</worldbody>\n</mujoco>\n";
}

TEST(CheckRepeats, RefusesCopiesBeforeTheyAreMade) {
  const std::string body = "<body><geom size='1'/></body>";
  const TemporaryFile file("bomb.xml",
                           Model("<replicate count='100000000'>" + body + "</replicate>"));
  EXPECT_THAT(
      [&] { LoadModel(file.path()); },
      ThrowsMessage<BadInput>(AllOf(HasSubstr("bomb.xml:3: count of <replicate> makes 1e+08"),
                                    HasSubstr("10000 at most"))));
}

TEST(CheckRepeats, MultipliesWhatIsNested) {
  const std::string ten = "<replicate count='10'>", end = "</replicate>";
  EXPECT_NO_THROW(CheckRepeats(Model(ten + ten + ten + end + end + end), "m.xml"));
  EXPECT_THAT([&] { CheckRepeats(Model(ten + ten + ten + ten + end + end + end + end), "m.xml"); },
              ThrowsMessage<BadInput>(HasSubstr("10000 copies of what it holds, 11110 in all")));
  EXPECT_THROW(CheckRepeats(Model("<flexcomp count='100 100 100'/>"), "m.xml"), BadInput);
  EXPECT_THROW(CheckRepeats(Model("<composite count='1e300 1e300'/>"), "m.xml"), BadInput);
}

TEST(CheckRepeats, LooksIntoIncludedFiles) {
  const TemporaryFile included("included.xml",
                               "<mujocoinclude><replicate count='20000'/></mujocoinclude>");
  const std::string name = std::filesystem::path(included.path()).filename();
  EXPECT_THROW(CheckRepeats(Model("<include file='" + name + "'/>"), included.path()), BadInput);
  EXPECT_NO_THROW(CheckRepeats(Model("<include file='absent.xml'/>"), included.path()));
}

TEST(CheckRepeats, RefusesAFileThatIncludesItself) {
  const TemporaryFile file("self.xml", " ");
  const std::string name = std::filesystem::path(file.path()).filename();
  const std::string text = "<mujoco><include file='" + name + "'/></mujoco>";
  std::ofstream(file.path()) << text;
  EXPECT_THAT([&] { CheckRepeats(text, file.path()); },
              ThrowsMessage<BadInput>(HasSubstr("nests deeper")));
}

TEST(CheckRepeats, RefusesDepthAndLargeTextures) {
  std::string deep;
  for (int i = 0; i < 501; ++i) deep += "<body>";
  EXPECT_THAT([&] { CheckRepeats(deep, "m.xml"); },
              ThrowsMessage<BadInput>(HasSubstr("nests deeper than 500 elements")));
  EXPECT_THAT([] { CheckRepeats("<texture width='40000' height='40000'/>", "m.xml"); },
              ThrowsMessage<BadInput>(HasSubstr("make 4.5 GiB")));
}

}  // namespace
}  // namespace warmjoint

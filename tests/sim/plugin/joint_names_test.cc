#include "sim/plugin/plugin_instances.h"

#include <gtest/gtest.h>

#include <set>

namespace warmjoint {
namespace {

Renaming Find(const InstanceNames& names, const std::set<std::string>& model,
              const std::vector<std::string>& driven = {}) {
  const auto exists = [&](const std::string& name) { return model.contains(name); };
  return FindRenaming(names, {"elbow", "wrist"}, driven, exists);
}

TEST(JointNames, StandAsTheyAreInAModelOfItsOwn) {
  const Renaming renaming = Find({"friction", "friction"}, {"elbow", "wrist"});
  EXPECT_EQ(renaming("elbow"), "elbow");
}

TEST(JointNames, HaveWhatStandsAroundTheInstancesWrittenName) {
  // the parent's own joints of the same names are not meant
  const std::set<std::string> model{"elbow", "wrist", "l/elbow_s", "l/wrist_s"};
  EXPECT_EQ(Find({"f", "l/f_s"}, model)("elbow"), "l/elbow_s");
  // the written name may stand in the prefix, too
  EXPECT_EQ(Find({"f", "fff"}, {"felbowf", "fwristf"})("wrist"), "fwristf");
}

TEST(JointNames, AreFoundWithoutAWrittenName) {
  EXPECT_EQ(Find({"", "left/friction"}, {"left/elbow", "left/wrist", "right/elbow"})("wrist"),
            "left/wrist");
  EXPECT_EQ(Find({"", ""}, {"a_elbow", "a_wrist"}, {"a_wrist", "a_elbow"})("elbow"), "a_elbow");
}

TEST(JointNames, StayWhereNothingFits) {
  EXPECT_EQ(Find({"f", "l/f"}, {"l/elbow", "l/wirst"})("wrist"), "wrist");
}

}  // namespace
}  // namespace warmjoint

#include "tools/report/draw/ticks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace warmjoint::report {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> Labels(const Axis& axis, int wanted) {
  std::vector<std::string> labels;
  for (const Tick& tick : AxisTicks(axis, wanted)) labels.push_back(tick.label);
  return labels;
}

TEST(AxisTicks, AreRoundAndInsideTheLimits) {
  EXPECT_THAT(Labels({"", 0, 10, Scale::linear, {}}, 5),
              ElementsAre("0", "2", "4", "6", "8", "10"));
  EXPECT_THAT(Labels({"", -0.3, 0.31, Scale::linear, {}}, 4), ElementsAre("−0.2", "0", "0.2"));
  EXPECT_THAT(Labels({"", -6e-5, 1e-6, Scale::linear, {}}, 4),
              ElementsAre("−6·10⁻⁵", "−4·10⁻⁵", "−2·10⁻⁵", "0"));
}

TEST(AxisTicks, AreDecadesOnLogarithmicAxes) {
  EXPECT_THAT(Labels({"", 0.5, 2000, Scale::logarithmic, {}}, 5),
              ElementsAre("1", "10", "100", "1000"));
  EXPECT_THAT(Labels({"", 0.9, 11, Scale::logarithmic, {}}, 6), ElementsAre("1", "2", "5", "10"));
  EXPECT_THAT(Labels({"", 1e-6, 1e-2, Scale::logarithmic, {}}, 5),
              ElementsAre("10⁻⁶", "10⁻⁵", "10⁻⁴", "0.001", "0.01"));
}

TEST(AxisTicks, ShareOnePowerOfTen) {
  EXPECT_THAT(Labels({"", 0, 2.2e-4, Scale::linear, {}}, 5),
              ElementsAre("0", "0.5·10⁻⁴", "1.0·10⁻⁴", "1.5·10⁻⁴", "2.0·10⁻⁴"));
}

TEST(SignificantText, RoundsAsPeopleDo) {
  EXPECT_EQ(SignificantText(15.0412), "15.0");
  EXPECT_EQ(SignificantText(-3.0), "−3.00");
  EXPECT_EQ(SignificantText(603.2), "603");
  EXPECT_EQ(SignificantText(-5.4e-5, 2), "−5.4·10⁻⁵");
  EXPECT_EQ(SignificantText(0), "0");
  EXPECT_EQ(SignificantText(0.09999, 2), "0.10") << "one more digit before the point";
  EXPECT_EQ(SignificantText(9.999e-5, 2), "1.0·10⁻⁴");
}

}  // namespace
}  // namespace warmjoint::report

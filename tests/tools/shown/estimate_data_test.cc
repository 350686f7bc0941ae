// What goes to the Python that draws.
#include "tools/shown/estimate_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/tools/shown/warm_recording.h"
#include "tools/shown/kernel_example.h"
#include "tools/shown/shown_estimate.h"

namespace warmjoint::shown {
namespace {

TEST(ShownData, IsALineOfJsonAndTheArraysBehindIt) {
  ShownData data;
  const Tree first = data.Hold(Eigen::VectorXd(Eigen::Vector3d(1, 2, std::nan(""))));
  const Tree second = data.Hold(Eigen::MatrixXd{{1, 2, 3}, {4, 5, 6}});
  data.facts = {{"a", first}, {"b", second}};
  EXPECT_EQ(second, (Tree{{"array", 1}, {"shape", {2, 3}}}));
  const std::string packed = Packed(data);
  const std::size_t end = packed.find('\n');
  const Tree head = Tree::parse(packed.substr(0, end));
  EXPECT_EQ(head["sizes"], (Tree{3, 6}));
  EXPECT_EQ(head["facts"], data.facts);
  ASSERT_EQ(packed.size(), end + 1 + 9 * sizeof(double));
  double numbers[9];
  std::memcpy(numbers, packed.data() + end + 1, sizeof(numbers));
  EXPECT_TRUE(std::isnan(numbers[2]));
  EXPECT_THAT(std::vector<double>(numbers + 3, numbers + 9),
              testing::ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST(RangeAtBound, StandsForAValueThatABoundHolds) {
  const auto range = [](double value, double lower, double upper) {
    return RangeAtBound({"viscous", value, "N.m.s/rad", 0.2, {{lower, upper}}});
  };
  EXPECT_EQ(range(1.2e-18, 0, 0.41), "0 to 0.41");
  EXPECT_EQ(range(0, 0, 0.41), "0 to 0.41");
  EXPECT_EQ(range(3, 1, 3), "1 to 3");
  EXPECT_FALSE(range(0.2, 0, 0.41));
  EXPECT_FALSE(range(0.02, 0, 0.41))
      << "within the interval: its bound cuts it, and the value is known";
  EXPECT_FALSE(RangeAtBound({"viscous", 0, "N.m.s/rad", {}, {}}));
}

TEST(ViewFacts, HoldsColumnsAndWhatTestsAskAndAdvise) {
  WarmRecording warm;
  Diagnostic direction;
  direction.test = "direction";
  direction.made = direction.rejected = true;
  Diagnostic unknown = direction;
  unknown.test = "humidity";
  warm.estimate.diagnostics = {direction, unknown};
  ShownData data;
  const Tree facts = ViewFacts(warm.View(), data);
  EXPECT_EQ(facts["tests"][0]["over"], "velocity");
  EXPECT_THAT(std::string(facts["tests"][0]["advice"]), testing::HasSubstr("law=asymmetric"));
  EXPECT_EQ(facts["tests"][1]["question"], "humidity");
  EXPECT_EQ(facts["tests"][1]["over"], "time");
  const std::size_t fitted = facts["columns"]["fitted"]["array"];
  EXPECT_EQ(data.arrays.at(fitted), warm.prediction.force);
  EXPECT_FALSE(facts["columns"].contains("motor_angle"));
  EXPECT_EQ(facts["segments"]["shape"], (Tree{60, 3}));
}

TEST(EstimateFacts, HasNoFirstGuessWhereMapsOrGravityWouldSpoilIt) {
  const WarmRecording warm;
  EstimateView view{warm.estimate, warm.measurements};
  view.fit = warm.View();
  ShownData data;
  EXPECT_FALSE(EstimateFacts(view, data)["guess"].is_null());
  const MappedRecording mapped;
  view = {mapped.estimate, mapped.measurements};
  view.fit = mapped.View();
  EXPECT_TRUE(EstimateFacts(view, data)["guess"].is_null());
  // without its recording an estimate has no columns
  EXPECT_TRUE(EstimateFacts({warm.estimate}, data)["fit"].is_null());
}

TEST(GuessFacts, IsNothingWhereNothingWarms) {
  WarmRecording warm;
  warm.measurements.torque =
      5 * warm.measurements.velocity.array() + 15 * warm.measurements.velocity.array().sign();
  RandomStream random({9, 0}, Stream::test);
  for (double& torque : warm.measurements.torque) torque += 0.5 * random.Normal();
  ShownData data;
  EXPECT_TRUE(GuessFacts(warm.measurements, warm.selection, std::nullopt, data).is_null());
}

TEST(KernelFacts, OfThePlainKindFallToZeroBeyondTheDataAndNormalisedOnesDoNot) {
  ShownData data;
  const Tree facts = KernelFacts(data);
  const auto array = [&](const Tree& mark) { return data.arrays.at(mark["array"]); };
  const Eigen::VectorXd truth = array(facts["truth"]), plain = array(facts["fits"]["plain"]),
                        normalised = array(facts["fits"]["normalised"]);
  const Eigen::Index last = truth.size() - 1, edge = 3 * last / 4;
  EXPECT_EQ(array(facts["t"])[edge], 2);
  // noise of 0.05 on 60 samples for 6 kernels: 0.016, four times; and the kernels' spacing of 0.8
  // cuts the parabola's corners by 0.6 * 0.8^2 / 8 = 0.048. At the edge the plain ones already fall
  constexpr double kClose = 4 * 0.016 + 0.048;
  for (const Eigen::VectorXd& fit : {plain, normalised}) {
    EXPECT_NEAR(fit[last / 2], -0.5, kClose);
    const Eigen::Index inside = 7 * last / 10;  // t = 1.6, half a spacing from the edge
    EXPECT_NEAR(fit[inside], truth[inside], kClose);
  }
  EXPECT_NEAR(normalised[edge], truth[edge], kClose);
  EXPECT_LT(std::abs(plain[last]), 0.2 * truth[edge]);
  EXPECT_GT(normalised[last], 0.9 * truth[edge]);
}

}  // namespace
}  // namespace warmjoint::shown

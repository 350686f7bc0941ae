#include "identification/alternating/block_descent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "identification/fit_data.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/linear_laws.h"
#include "identification/preparation/select.h"
#include "tests/support/vectors.h"

namespace warmjoint {
namespace {

/// Algorithm 1 on the golden recording (h = 15 s) with law (2).
class GoldenLoop {
 public:
  GoldenLoop() : recording_(test::GoldenRecording()), moving_(SelectMoving(recording_)) {
    const Eigen::MatrixXd columns = LawColumns(*FindLaw("viscous_coulomb"), recording_.velocity);
    const LeastSquares nominal =
        SolveLeastSquares(Kept(columns, moving_), Kept(recording_.torque, moving_));
    const Eigen::VectorXd no_gravity = Eigen::VectorXd::Zero(recording_.size());
    loop_.emplace(recording_, moving_, columns, nominal.cofactor, no_gravity);
  }

  DescentState After(const Thermal& start, int iterations) const {
    DescentState state = loop_->Start(start);
    for (int i = 0; i < iterations; ++i) state = loop_->Next(state);
    return state;
  }

  /// kv, kc, ke, te
  Eigen::Vector4d Discrete(const DescentState& state) const {
    const DiscreteThermal pair = Discretise(state.thermal, 15.0);
    return {state.nominal[0], state.nominal[1], pair.gain, pair.pole};
  }

  /// RMSE over all 240 samples, as the golden numbers count it: the 8 at rest are all residual.
  double RmseWithRests(const DescentState& state) const {
    const double kept = static_cast<double>(moving_.count());
    const double rests = moving_.keep.select(0, recording_.torque.array().square()).sum();
    return std::sqrt((state.rmse * state.rmse * kept + rests) / 240);
  }

  const BlockDescent& loop() const { return *loop_; }

 private:
  Measurements recording_;
  Selection moving_;
  std::optional<BlockDescent> loop_;
};

void FollowsTheGoldenIterations(const char* key) {
  const nlohmann::json& golden = test::Golden().at("dataset").at(key);
  const GoldenLoop loop;
  for (size_t row = 0; row < golden.at("iters").size(); ++row) {
    const int iterations = golden["iters"][row];
    const DescentState state = loop.After({golden.at("kbar0"), golden.at("tbar0")}, iterations);
    const Eigen::VectorXd expected = test::ToVector(golden.at("kv_kc_ke_te")[row]);
    // iterative optimiser: 1e-6 on parameters, 1e-10 on cost (golden/README)
    EXPECT_LT((loop.Discrete(state) - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff(), 1e-6)
        << key << " after " << iterations;
    const double rmse = golden.at("rmse")[row];
    EXPECT_NEAR(loop.RmseWithRests(state), rmse, 1e-6 * rmse) << key << " after " << iterations;
  }
}

TEST(BlockDescent, FollowsTheGoldenIterationsFromStartA) {
  FollowsTheGoldenIterations("alg1_start_a");
}

TEST(BlockDescent, FollowsTheGoldenIterationsFromStartB) {
  FollowsTheGoldenIterations("alg1_start_b");
}

TEST(BlockDescent, EndsAtTheJointOpenLoopSolution) {
  const nlohmann::json& golden = test::Golden().at("dataset");
  const GoldenLoop loop;
  const Eigen::Vector4d end = loop.Discrete(loop.After({-3, 600}, 3000));
  const nlohmann::json& joint = golden.at("joint_open");
  Eigen::Vector4d expected;
  expected << joint.at("kv").get<double>(), joint.at("kc").get<double>(),
      joint.at("ke").get<double>(), joint.at("te").get<double>();
  EXPECT_LT((end - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(BlockDescent, ConvergesAtTheGoldenLinearRate) {
  const nlohmann::json& golden = test::Golden().at("dataset");
  const GoldenLoop loop;
  const double end = loop.After({-3, 600}, 3000).nominal[1];
  const double early = loop.After({-1, 300}, 100).nominal[1] - end;
  const double late = loop.After({-1, 300}, 150).nominal[1] - end;
  // 1e-3: the golden rate was observed at other iterations, where it differs by as much from theory
  EXPECT_NEAR(std::pow(late / early, 1.0 / 50), golden.at("alg1_linear_rate_theory"), 1e-3);
}

TEST(BlockDescent, JacobianAgreesWithFiniteDifferences) {
  const GoldenLoop loop;
  DescentState state = loop.After({-3, 600}, 1);
  const Eigen::MatrixXd jacobian = loop.loop().Jacobian(state);
  const double step = 1e-5;
  for (Eigen::Index j = 0; j < 4; ++j) {
    const auto moved = [&](double by) {
      DescentState other = state;
      if (j < 2) other.nominal[j] += by;
      if (j == 2) other.thermal.gain += by;
      if (j == 3) other.thermal.time_constant *= std::exp(by);
      return loop.loop().Fitted(other);
    };
    const Eigen::VectorXd difference = (moved(step) - moved(-step)) / (2 * step);
    // central differences: rounding eps |tau| / step = 4e-10 N.m and step^2 / 6 times the third
    // derivative (20 N.m) = 3e-10 N.m a sample, over 240 samples
    EXPECT_LT((jacobian.col(j) - difference).norm(), 2e-8) << j;
  }
}

}  // namespace
}  // namespace warmjoint

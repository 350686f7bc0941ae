#include "identification/alternating/output_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/vectors.h"

namespace warmjoint {
namespace {

/// 400 samples, 1 s apart: 40 s of motion that warms, 40 s at rest, and so on.
struct Example {
  Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(400, 0, 399);
  Eigen::VectorXd loss{400};
  Selection selection{Eigen::Array<bool, Eigen::Dynamic, 1>(400), {}};
  Thermal thermal{-2, 70};

  Example() {
    for (Eigen::Index i = 0; i < 400; ++i) {
      selection.keep[i] = i / 40 % 2 == 0;
      loss[i] = selection.keep[i] ? 3 + std::sin(0.2 * static_cast<double>(i)) : 0.0;
    }
  }
  OutputError Problem() const { return OutputError(time, loss, selection); }
};

TEST(OutputError, FitsTheGoldenFirstIteration) {
  const auto& dataset = test::Golden()["dataset"];
  const auto& golden = dataset["oe_fit_first_iteration_a"];
  const double h = dataset["h"];
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(240, 0, 239 * h);
  const Selection selection{test::ToVector(golden["mask"]).array() != 0, {}};
  const OutputError problem(time, test::ToVector(golden["W"]), selection);
  const Eigen::VectorXd energy = test::ToVector(golden["Ehat"]);

  const OutputError::Fit fit = problem.Refine(energy, problem.Scan(energy));
  const DiscreteThermal pair = Discretise(fit.thermal, h);
  // iterative optimiser: 1e-6 on parameters, 1e-10 on cost (golden/README)
  EXPECT_NEAR(pair.gain, golden["ke"], 1e-6 * std::abs(golden["ke"].get<double>()));
  EXPECT_NEAR(pair.pole, golden["te"], 1e-6);
  EXPECT_NEAR(fit.cost, golden["cost"], 1e-10 * golden["cost"].get<double>());
  EXPECT_TRUE(fit.inside);
}

TEST(OutputError, RecoversTheFilterFromAnyStart) {
  const Example example;
  const OutputError problem = example.Problem();
  const Eigen::VectorXd energy = problem.filter().Energy(example.thermal, example.loss);
  for (double start : {1.0, 20.0, 69.0, 200.0, 1000.0}) {
    const OutputError::Fit fit = problem.Refine(energy, start);
    // noise free: what is left is the last Newton step, squared
    EXPECT_NEAR(fit.thermal.time_constant, 70, 70 * 1e-9) << start;
    EXPECT_NEAR(fit.thermal.gain, -2, 2e-9) << start;
  }
}

TEST(OutputError, KeepsTheFilterRunningThroughRests) {
  // cutting the rests out instead would leave no cooling and so no time constant near 70 s
  Example example;
  const Eigen::VectorXd energy = example.Problem().filter().Energy(example.thermal, example.loss);
  Eigen::VectorXd disturbed = energy;
  for (Eigen::Index i = 0; i < 400; ++i) disturbed[i] += example.selection.keep[i] ? 0.0 : 100.0;
  EXPECT_EQ(example.Problem().Refine(disturbed, 60).thermal.time_constant,
            example.Problem().Refine(energy, 60).thermal.time_constant);
}

TEST(OutputError, FindsNoCheaperNeighbour) {
  const Example example;
  const OutputError problem = example.Problem();
  Eigen::VectorXd energy = problem.filter().Energy(example.thermal, example.loss);
  for (Eigen::Index i = 0; i < 400; ++i) energy[i] += 0.5 * std::sin(1.7 * static_cast<double>(i));
  const OutputError::Fit fit = problem.Refine(energy, problem.Scan(energy));

  const auto cost = [&](double gain, double time_constant) {
    const Eigen::VectorXd fitted = problem.filter().Energy({gain, time_constant}, example.loss);
    return example.selection.keep.select((energy - fitted).array().square(), 0).sum();
  };
  const auto [gain, tau] = fit.thermal;
  EXPECT_NEAR(fit.cost, cost(gain, tau), 1e-10 * fit.cost);
  for (double change : {-1e-3, 1e-3}) {
    EXPECT_GT(cost(gain * (1 + change), tau), fit.cost);
    EXPECT_GT(cost(gain, tau * (1 + change)), fit.cost);
  }
}

TEST(OutputError, SaysWhenTheTimeConstantRunsAway) {
  // an energy that only ramps looks the same for every time constant above the recording
  const Example example;
  const OutputError problem = example.Problem();
  Eigen::VectorXd energy = Eigen::VectorXd::Zero(400);
  for (Eigen::Index i = 1; i < 400; ++i) energy[i] = energy[i - 1] - example.loss[i - 1];
  const OutputError::Fit fit = problem.Refine(energy, 1000);
  EXPECT_FALSE(fit.inside);
  EXPECT_DOUBLE_EQ(fit.thermal.time_constant, problem.longest());
}

}  // namespace
}  // namespace warmjoint

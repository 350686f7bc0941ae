#include <gtest/gtest.h>

#include "identification/estimate.h"
#include "tests/support/vectors.h"

namespace warmjoint {
namespace {

TEST(Metrics, ReproduceTheGoldenIndicators) {
  WARMJOINT_NEED_SHARED("golden/golden.json");
  const nlohmann::json& golden = test::Golden().at("indicators");
  const int d = golden.at("d");
  const Metrics metrics =
      ComputeMetrics(test::ToVector(golden.at("y")), test::ToVector(golden.at("yhat")), d, d);

  // 1e-12: closed forms
  EXPECT_NEAR(metrics.fit, golden.at("Fit"), 1e-12 * 100);
  EXPECT_NEAR(metrics.fpe, golden.at("FPE"), 1e-12);
  EXPECT_NEAR(metrics.rmse, golden.at("RMSE"), 1e-12);
  EXPECT_NEAR(metrics.mae, golden.at("MAE"), 1e-12);
  EXPECT_EQ(metrics.n, 5);
}

}  // namespace
}  // namespace warmjoint

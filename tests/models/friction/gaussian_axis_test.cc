#include <gmock/gmock.h>
#include <warmjoint/friction.h>

#include <numbers>
#include <numeric>

#include "models/friction/evaluate_map.h"
#include "tests/support/shared_data.h"

namespace warmjoint {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Pointwise;

std::vector<double> Kernels(const GaussianAxis& axis, KernelKind kind, double x) {
  std::vector<double> phi(axis.size());
  AxisKernels(axis, kind, x, phi.data());
  return phi;
}

/// Each kernel at each position of a golden entry, to 1e-12 (closed forms).
void ExpectGolden(const nlohmann::json& golden, const char* key, const GaussianAxis& axis,
                  KernelKind kind) {
  const std::vector<double> positions = golden.at("p");
  for (size_t i = 0; i < positions.size(); ++i) {
    const std::vector<double> expected = golden.at(key)[i];
    const std::vector<double> phi = Kernels(axis, kind, positions[i]);
    for (size_t k = 0; k < expected.size(); ++k) {
      EXPECT_NEAR(phi[k], expected[k], 1e-12 * expected[k]) << positions[i] << " " << k;
    }
  }
}

TEST(GaussianAxis, ReproducesTheGoldenKernels) {
  const nlohmann::json& golden = test::Golden().at("rbf1");
  const GaussianAxis axis{golden.at("mu"), golden.at("sigma"), {}, Sides::together};
  ExpectGolden(golden, "phi", axis, KernelKind::plain);
  ExpectGolden(golden, "phi_normalised", axis, KernelKind::normalised);
}

TEST(GaussianAxis, ReproducesTheGoldenKernelsOnTheCircle) {
  const nlohmann::json& golden = test::Golden().at("rbf_periodic");
  const GaussianAxis axis{golden.at("mu"), golden.at("sigma"), golden.at("period"),
                          Sides::together};
  ExpectGolden(golden, "phi_normalised", axis, KernelKind::normalised);
}

TEST(GaussianAxis, StaysFiniteFarFromEveryCentre) {
  const GaussianAxis axis = EvenAxis(-1, 1, 5);
  EXPECT_THAT(Kernels(axis, KernelKind::normalised, 1e6), ElementsAre(0, 0, 0, 0, 1));
  EXPECT_THAT(Kernels(axis, KernelKind::normalised, -1e6), ElementsAre(1, 0, 0, 0, 0));
}

TEST(GaussianAxis, KeepsTheSidesApart) {
  const GaussianAxis axis = SpeedAxis(0.1, 1, 2);
  EXPECT_THAT(axis.centres, ElementsAre(-1, -0.1, 0.1, 1));
  const std::vector<double> forwards = Kernels(axis, KernelKind::normalised, 0.3);
  EXPECT_EQ(forwards[0] + forwards[1], 0);
  EXPECT_NEAR(forwards[2] + forwards[3], 1, 1e-15);
  EXPECT_THAT(Kernels(axis, KernelKind::normalised, 0), ElementsAre(0, 0, 0, 0));
}

TEST(GaussianAxis, GoesRoundTheCircle) {
  const double turn = 2 * std::numbers::pi;
  const GaussianAxis axis = CircleAxis(turn, 6);
  // 1e-12: rounding of an angle of 30 rad
  EXPECT_THAT(Kernels(axis, KernelKind::normalised, 0.3 + 5 * turn),
              Pointwise(DoubleNear(1e-12), Kernels(axis, KernelKind::normalised, 0.3)));
}

}  // namespace
}  // namespace warmjoint

#include "models/friction/prepared_axis.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "models/foundation/random_stream.h"
#include "models/friction/evaluate_map.h"
#include "tests/support/axes_of_every_kind.h"

namespace warmjoint {
namespace {

class PreparedAxes : public testing::TestWithParam<KernelKind> {};

TEST_P(PreparedAxes, TellTheKernelsOfTheirRow) {
  for (const GaussianAxis& axis : test::AxesOfEveryKind()) {
    SCOPED_TRACE(testing::Message() << axis.size() << " centres");
    const PreparedAxis prepared(axis, GetParam());
    const std::vector<int> row = prepared.Row();
    RandomStream random({4, 1}, Stream::test);
    ActiveKernels active;
    for (int i = 0; i < 200; ++i) {
      const double x = random.Uniform(-5, 5);
      prepared.Kernels(x, active);
      std::array<double, kMostMapCentres> exact{}, told{};
      AxisKernels(axis, GetParam(), x, exact.data());
      for (int k = 0; k < active.count; ++k) {
        const int centre = row.at(static_cast<size_t>(active.first + k));
        if (centre < 0) continue;
        told[static_cast<size_t>(centre)] +=
            active.value[static_cast<size_t>(active.begin + k)] / active.sum;
      }
      // 3e-13 for kernels that are left out, 1e-13 of a spacing for centres off the grid
      for (size_t k = 0; k < axis.size(); ++k) ASSERT_NEAR(told[k], exact[k], 1e-12) << x;
    }
  }
}

TEST_P(PreparedAxes, EndTheirKernelsInZerosForWhoTakesFourAtATime) {
  for (const GaussianAxis& axis : test::AxesOfEveryKind()) {
    const PreparedAxis prepared(axis, GetParam());
    ActiveKernels active;
    for (double x = -4; x < 4; x += 0.37) {
      active.value.fill(std::nan(""));
      prepared.Kernels(x, active);
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(active.value.at(static_cast<size_t>(active.begin + active.count + k)), 0) << x;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, PreparedAxes,
                         testing::Values(KernelKind::plain, KernelKind::normalised),
                         [](const auto& one) {
                           return one.param == KernelKind::plain ? "plain" : "normalised";
                         });

}  // namespace
}  // namespace warmjoint

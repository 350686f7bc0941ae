#include "identification/lack_of_fit/wave_products.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(WaveProducts, AreSumsAtEachFrequency) {
  RandomStream random({1, 0}, Stream::test);
  const VectorXd values = VectorXd::NullaryExpr(70, [&] { return random.Normal(); });
  const VectorXd times = VectorXd::NullaryExpr(70, [&] { return random.Uniform(); });
  // from none, less than as many steps as a centre reaches, as many, and more
  for (const Index first : {0, 5, 8, 20}) {
    // fewer than one centre reaches, one more, and many
    for (const Index count : {1, 17, 18, 200}) {
      const Frequencies frequencies{0.5, first, count};
      const MatrixXd products = WaveProducts(values, times, frequencies);
      ASSERT_EQ(products.rows(), count);
      for (Index k = 0; k < count; ++k) {
        const Eigen::ArrayXd angle = 2 * std::numbers::pi * frequencies.At(k) * times.array();
        // rounding of 70 products, of waves that some 30 turns made
        EXPECT_NEAR(products(k, 0), (values.array() * angle.cos()).sum(), 1e-12) << count;
        EXPECT_NEAR(products(k, 1), (values.array() * angle.sin()).sum(), 1e-12) << count;
      }
    }
  }
  EXPECT_EQ(WaveProducts(VectorXd(), VectorXd(), {1, 1, 3}), MatrixXd::Zero(3, 2));
}

TEST(EvenWaves, AreCosinesAndSines) {
  for (const Index count : {0, 1, 64, 65, 300}) {
    const MatrixXd waves = EvenWaves(0.3, 0.07, count);
    ASSERT_EQ(waves.rows(), count);
    for (Index i = 0; i < count; ++i) {
      const double angle = 0.3 + 0.07 * static_cast<double>(i);
      EXPECT_NEAR(waves(i, 0), std::cos(angle), 1e-14);
      EXPECT_NEAR(waves(i, 1), std::sin(angle), 1e-14);
    }
  }
}

}  // namespace
}  // namespace warmjoint

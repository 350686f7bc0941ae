#include "identification/ridge/kernel_rows.h"

#include <gtest/gtest.h>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

constexpr Eigen::Index kSamples = 500, kSpans = 4;

/// Two columns without a prior, a torque, and kernels over position for each direction.
class KernelRowsTest : public ::testing::Test {
 protected:
  KernelRowsTest() : points_(MapPoints::Zero(kSamples, 5)) {
    RandomStream random({5, 0}, Stream::motion);
    for (Eigen::Index i = 0; i < kSamples; ++i) {
      points_(i, 0) = random.Uniform(-1, 1);
      points_(i, 2) = random.Uniform(-1, 1);
    }
    for (double& value : free_.reshaped()) value = random.Normal();
    for (double& value : torque_) value = random.Normal();
  }

  const std::vector<FrictionMap> maps_{
      {{{MapQuantity::position, EvenAxis(-1, 1, 24)}, {MapQuantity::velocity, SpeedAxis(1, 1, 1)}},
       KernelKind::normalised,
       {}}};
  MapPoints points_;
  Eigen::MatrixXd free_{kSamples, 2};
  Eigen::VectorXd torque_{kSamples};
};

TEST_F(KernelRowsTest, GiveTheNormalEquationsOfEachSpanAndOfAll) {
  const KernelRows rows(maps_, points_, kSpans);
  ASSERT_EQ(rows.spans(), kSpans);
  for (Eigen::Index i = 0; i < kSpans; ++i) {
    const NormalEquations made = LocalNormal(maps_, points_, free_, torque_, i * kSamples / kSpans,
                                             (i + 1) * kSamples / kSpans);
    const NormalEquations kept = rows.Normal(i, free_, torque_);
    EXPECT_EQ(kept.rows, made.rows);
    EXPECT_EQ((kept.gram - made.gram).norm(), 0);
    EXPECT_EQ((kept.product - made.product).norm(), 0);
  }

  // the sums are taken in another order: rounding of 500 terms
  const NormalEquations made = LocalNormal(maps_, points_, free_, torque_, 0, kSamples);
  const NormalEquations kept = rows.Normal(free_, torque_);
  EXPECT_LE((kept.gram - made.gram).norm(), 1e-12 * made.gram.norm());
  EXPECT_LE((kept.product - made.product).norm(), 1e-12 * made.product.norm());
}

TEST_F(KernelRowsTest, TimesWeightsAreTheMapsValues) {
  const KernelRows rows(maps_, points_, kSpans);
  const Eigen::VectorXd weights = Eigen::VectorXd::LinSpaced(KernelCount(maps_), -1, 2);
  const Eigen::VectorXd values = DenseKernels(maps_, points_, 0, kSamples) * weights;
  EXPECT_LE((rows.Times(weights) - values).cwiseAbs().maxCoeff(), 1e-14);
}

TEST_F(KernelRowsTest, AreNotKeptWhereTheyAreTooMany) {
  EXPECT_TRUE(KernelRows::Fit(maps_, 100000));
  EXPECT_FALSE(KernelRows::Fit(maps_, 1000000));
}

}  // namespace
}  // namespace warmjoint

#include "identification/lack_of_fit/with_heat.h"

#include <gtest/gtest.h>

#include "identification/linear/linear_laws.h"
#include "models/friction/along_motion.h"
#include "models/recording/course_of.h"
#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

/// A fit of the truth, as far as WithHeat asks.
FittedModel Warm(const Friction& friction, const Measurements& m) {
  FittedModel model;
  model.thermal = friction.thermal;
  model.loop = ClosedLoop::Along(m, LawColumns(*FindLaw(friction.law), m.velocity));
  return model;
}

/// Each sample by itself.
Bins Samples(const Measurements& m) {
  Bins bins;
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    bins.begin.push_back(i);
    bins.end.push_back(i + 1);
  }
  bins.weight = Eigen::VectorXd::Ones(m.size());
  return bins;
}

/// WithHeat of forces that stand in rows, with losses at the same velocity. forces: [N x C]
template <int C>
Eigen::MatrixXd OfRows(const FittedModel& model, const Measurements& m, const Bins& bins,
                       const Eigen::Matrix<double, Eigen::Dynamic, C>& forces) {
  // a level acts against the motion
  const auto levels = [&](Eigen::Index n, Fours<1>& level) {
    level[0] = Four{};
    for (int k = 0; k < C; ++k) level[0][k] = Sign(m.velocity[n]) * forces(n, k);
  };
  const auto same = [](Eigen::Index, Fours<1>&) {};
  return WithHeat<1>(model, m.velocity, bins, levels, same).leftCols(C);
}

Prediction Along(const Friction& friction, const Measurements& m) {
  return AlongMotion(friction).Predict(CourseOf(m, BristleStart::torque), {});
}

/// (F(+step) - F(-step)) / (2 step). [N]
Eigen::VectorXd Slope(const Friction& above, const Friction& below, const Measurements& m,
                      double step) {
  return (Along(above, m).force - Along(below, m).force) / (2 * step);
}

TEST(WithHeat, IsTheDerivativeByALevel) {
  const Friction friction = test::TableOne();
  const Measurements m = test::RecordFriction(friction, 1, test::AlternatingSpeeds(1200, 1), 0, 1);
  const double step = 0.01;
  Friction above = friction, below = friction;
  above.parameters["coulomb"] += step;
  below.parameters["coulomb"] -= step;
  const Eigen::VectorXd sign = m.velocity.array().sign().matrix();
  // F is linear in coulomb: what differs is rounding, 1e-16 of 20 N.m over 0.02
  const Eigen::VectorXd off =
      OfRows<1>(Warm(friction, m), m, Samples(m), sign) - Slope(above, below, m, step);
  EXPECT_LT(off.lpNorm<Eigen::Infinity>(), 1e-11);
}

TEST(WithHeat, IsTheDerivativeByASlopeThatWarms) {
  const Friction friction = test::TableOne();
  const Measurements m = test::RecordFriction(friction, 1, test::AlternatingSpeeds(1200, 2), 0, 2);
  const double step = 1e-4;
  Friction above = friction, below = friction;
  above.viscous_per_energy = step;
  below.viscous_per_energy = -step;
  const Eigen::VectorXd slope = m.velocity.cwiseProduct(Along(friction, m).energy);
  // by the third derivative, of some 10 N.m: step^2 times that
  const Eigen::VectorXd off =
      OfRows<1>(Warm(friction, m), m, Samples(m), slope) - Slope(above, below, m, step);
  EXPECT_LT(off.lpNorm<Eigen::Infinity>(), 1e-6);
}

TEST(WithHeat, IsTheDerivativeByTheLawsParameters) {
  const Friction friction = test::TableOne();
  const Measurements m = test::RecordFriction(friction, 1, test::AlternatingSpeeds(1200, 1), 0, 1);
  const FittedModel model = Warm(friction, m);
  const Eigen::MatrixX2d columns = LawColumns(*FindLaw(friction.law), m.velocity);
  // F is linear in them, wherever they are
  const Eigen::MatrixXd all = model.loop->Jacobian(Eigen::Vector2d(5, 15), *friction.thermal);
  const Eigen::MatrixXd off = OfRows<2>(model, m, Samples(m), columns) - all.leftCols(2);
  // 1e-14: the same recursion, of some 10
  EXPECT_LT(off.cwiseAbs().maxCoeff(), 1e-14);
  // over bins, their means
  const Bins holds =
      MakeBins(m, {Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(m.size(), true), {}});
  ASSERT_LT(holds.size(), m.size());
  const Eigen::MatrixXd apart = OfRows<2>(model, m, holds, columns) - holds.Means(all.leftCols(2));
  EXPECT_LT(apart.cwiseAbs().maxCoeff(), 1e-13);
}

TEST(WithHeat, IsTheForceItselfWhereNothingWarms) {
  const Measurements m =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(100, 1), 0, 1);
  const Eigen::VectorXd force = m.velocity.cwiseAbs2();
  EXPECT_EQ(OfRows<1>({}, m, Samples(m), force), force);
}

}  // namespace
}  // namespace warmjoint

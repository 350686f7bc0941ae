#include "identification/adequacy/lag.h"

#include <gmock/gmock.h>

#include "identification/preparation/select.h"
#include "tests/support/judging.h"

namespace warmjoint {
namespace {

using test::Answer;
using test::Count;
using test::kInadequate;
using test::kNearlyAll;
using test::RecordHour;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kReason = "depends on the time since the last change of speed";

/// Torque that shows share[k] of what it was k + 1 samples ago.
Measurements Late(Measurements m, double share) {
  const Eigen::VectorXd now = m.torque;
  for (Eigen::Index i = 1; i < m.size(); ++i) m.torque[i] += share * (now[i - 1] - now[i]);
  return m;
}

TEST(FindLag, FindsATorqueThatIsASampleLate) {
  const auto late = [](std::uint64_t seed) { return Late(RecordHour(test::TableOne(), seed), 1); };
  EXPECT_GE(Count("energy-ml", kInadequate, kReason, late), kNearlyAll);
  EXPECT_THAT(Answer("energy-ml", late(1)).message, HasSubstr("filtered or late"));
}

TEST(FindLag, FindsAFilter) {
  // first order, 2 s at 1 Hz
  Measurements m = RecordHour(test::TableOne(), 1);
  for (Eigen::Index i = 1; i < m.size(); ++i) {
    m.torque[i] = m.torque[i - 1] + (1 - std::exp(-0.5)) * (m.torque[i] - m.torque[i - 1]);
  }
  const Estimate estimate = Answer("energy-ml", m);
  EXPECT_EQ(estimate.status, kInadequate);
  EXPECT_THAT(estimate.message, HasSubstr(kReason));
}

TEST(FindLag, FindsNoneWhereThereIsNone) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    EXPECT_THAT(Answer("energy-ml", RecordHour(test::TableOne(), seed)).message,
                Not(HasSubstr(kReason)))
        << seed;
    EXPECT_THAT(Answer("nominal-ls", RecordHour(test::TableOne(), seed)).message,
                Not(HasSubstr(kReason)))
        << seed;
  }
}

TEST(FindLag, TakesWhatItFindsOffTheResidual) {
  const Measurements m = Late(RecordHour(test::Cold(), 1, 0.1), 0.4);
  FittedModel model;
  model.selection = SelectMoving(m);
  model.torque = m.torque;
  const Eigen::ArrayXd speed = m.velocity.array();
  model.residual = m.torque - (5 * speed + 15 * speed.sign()).matrix();
  model.derivatives.resize(m.size(), 2);
  model.derivatives << speed.matrix(), speed.sign().matrix();
  Eigen::VectorXd rest = model.residual;
  const auto found = FindLag(model, m, rest);
  ASSERT_TRUE(found);
  // 0.4 of the change is left for one sample of 1 s; what is left is noise
  EXPECT_NEAR(found->period, 0.4, 0.05);
  EXPECT_NEAR(rest.norm() / std::sqrt(3600.0), 0.1, 0.02);
}

}  // namespace
}  // namespace warmjoint

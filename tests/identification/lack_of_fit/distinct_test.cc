#include "identification/lack_of_fit/distinct.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace warmjoint {
namespace {

using testing::ElementsAre;

TEST(Distinct, TellsWhichNumberEachIs) {
  // in order, out of order, and one that comes late
  const Eigen::VectorXd all = Eigen::Vector<double, 9>{0.5, 2, 3, 0.5, 2, 3, 2, 7, 0.5};
  const Distinct distinct(all);
  EXPECT_THAT(distinct.numbers, ElementsAre(0.5, 2, 3, 7));
  EXPECT_THAT(distinct.place, ElementsAre(0, 1, 2, 0, 1, 2, 1, 3, 0));
  EXPECT_EQ(distinct.values()[3], 7);
}

TEST(Distinct, HasNothingOfNothing) { EXPECT_EQ(Distinct(Eigen::VectorXd()).values().size(), 0); }

}  // namespace
}  // namespace warmjoint

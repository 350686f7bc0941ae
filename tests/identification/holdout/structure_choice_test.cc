#include "identification/holdout/structure_choice.h"

#include <gtest/gtest.h>

namespace warmjoint {
namespace {

Eigen::VectorXd Four(double a, double b, double c, double d) {
  return (Eigen::VectorXd(4) << a, b, c, d).finished();
}

TEST(StructureChoice, TakesTheBestThatIsBetterBeyondDoubt) {
  const Choice choice = ChooseStructure(
      {{"plain", Four(2, 2.1, 1.9, 2), 2, 2}, {"rich", Four(1, 1.1, 0.9, 1), 1, 4}}, 1000);
  EXPECT_EQ(choice.chosen, 1u);
  EXPECT_EQ(choice.best, 1u);
}

TEST(StructureChoice, TakesTheSimplerOneWithinOneStandardErrorOfTheDifference) {
  // difference 0.1, 0.3, -0.2, 0.1: mean 0.075, standard error 0.103; BIC is for the rich one
  const Choice choice = ChooseStructure(
      {{"plain", Four(1.1, 1.4, 0.7, 1.1), 1.05, 2}, {"rich", Four(1, 1.1, 0.9, 1), 1, 4}}, 1000);
  EXPECT_EQ(choice.chosen, 0u);
  EXPECT_EQ(choice.best, 1u);
  EXPECT_NEAR(choice.excess, 0.075, 1e-12);
  EXPECT_NEAR(choice.doubt, 0.10308, 1e-5);
}

TEST(StructureChoice, TakesTheSimplerOneThatBicPrefers) {
  // worse by a millionth on every block, which is beyond doubt but not worth two parameters
  const Choice choice =
      ChooseStructure({{"plain", Four(1.000001, 1.000001, 1.000001, 1.000002), 1.000001, 2},
                       {"rich", Four(1, 1, 1, 1), 1, 4}},
                      1000);
  EXPECT_EQ(choice.chosen, 0u);
}

TEST(StructureChoice, TakesTheBetterOfTwoEquallySimpleOnes) {
  const Choice choice = ChooseStructure(
      {{"one", Four(1.1, 1.4, 0.7, 1.1), 1.05, 2}, {"other", Four(1, 1.1, 0.9, 1), 1, 2}}, 1000);
  EXPECT_EQ(choice.chosen, 1u);
}

}  // namespace
}  // namespace warmjoint

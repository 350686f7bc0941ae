#include "identification/physical_bounds.h"

#include <gtest/gtest.h>

namespace warmjoint {
namespace {

/// A fit of a law that breaks away, with the viscous friction and the level at rest of a test.
Fit StictionFit(double viscous, double at_rest) {
  Fit fit;
  fit.friction.law = "stiction";
  fit.friction.parameters = {{"viscous", viscous}, {"coulomb", 10}, {"static", at_rest}};
  fit.parameters = {
      FitParameter{.name = "viscous", .value = viscous, .unit = "N.m.s/rad", .lower = 0}};
  return fit;
}

TEST(PhysicalBounds, GiveAFrictionWhoseValuesLieInside) {
  EXPECT_TRUE(GivesFriction(StictionFit(1, 12)));
  EXPECT_FALSE(GivesFriction(StictionFit(-1, 12)));
}

TEST(PhysicalBounds, GiveNoFrictionThatRisesFromRest) {
  EXPECT_EQ(RisesFromRest(StictionFit(1, 8).friction), "static is below coulomb");
  EXPECT_FALSE(GivesFriction(StictionFit(1, 8)));
}

TEST(PhysicalBounds, GiveNoFrictionOfAFitThatIsRefused) {
  EXPECT_FALSE(GivesFriction(Refused("energy-ml", Status::not_converged, "it went on")));
}

}  // namespace
}  // namespace warmjoint

#include "identification/linear/against_pushing.h"

#include <gmock/gmock.h>

namespace warmjoint {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(AgainstPushing, NamesWhatTheFitDoesNotHold) {
  EXPECT_THAT(AgainstPushing("energy-ml", "viscous_coulomb", "none"),
              "try --identifier energy-ml --set law=asymmetric");
  EXPECT_THAT(AgainstPushing("energy-ml", "viscous_coulomb", "sincos"),
              HasSubstr("law=asymmetric --gravity sincos"));
  EXPECT_THAT(AgainstPushing("energy-ml", "asymmetric", "none"), HasSubstr("--gravity paired"));
  EXPECT_THAT(AgainstPushing("energy-ml", "asymmetric", "paired"), Not(HasSubstr("try")));
}

}  // namespace
}  // namespace warmjoint

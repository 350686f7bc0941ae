#include "models/foundation/nearest_name.h"

#include <gmock/gmock.h>

namespace warmjoint {
namespace {

TEST(EditDistance, CountsEachKindOfSlipOnce) {
  EXPECT_EQ(EditDistance("speeds", "speeds"), 0);
  EXPECT_EQ(EditDistance("speds", "speeds"), 1);
  EXPECT_EQ(EditDistance("speedss", "speeds"), 1);
  EXPECT_EQ(EditDistance("spaeds", "speeds"), 1);
  EXPECT_EQ(EditDistance("sepeds", "speeds"), 1);
  EXPECT_EQ(EditDistance("", "abc"), 3);
}

TEST(Suggestion, NamesTheNearest) {
  EXPECT_EQ(Suggestion("viscos", {"coulomb", "viscous"}),
            "; did you mean 'viscous'? Known: coulomb, viscous");
}

TEST(Suggestion, StaysSilentAboutStrangers) {
  EXPECT_EQ(Suggestion("temperature", {"coulomb", "viscous"}), "; known: coulomb, viscous");
  EXPECT_EQ(Suggestion("anything", {}), "");
}

}  // namespace
}  // namespace warmjoint

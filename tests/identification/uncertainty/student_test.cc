#include "identification/uncertainty/student.h"

#include <gtest/gtest.h>

namespace warmjoint {
namespace {

// tabulated 97.5 % quantiles, printed to 3 digits; the expansion is off by 0.3 % at 3 and less
// above
TEST(StudentQuantile, AgreesWithTheTable) {
  EXPECT_NEAR(StudentQuantile(1), 12.706, 5e-4);
  EXPECT_NEAR(StudentQuantile(2), 4.303, 5e-4);
  EXPECT_NEAR(StudentQuantile(3), 3.182, 0.01);
  EXPECT_NEAR(StudentQuantile(5), 2.571, 1e-3);
  EXPECT_NEAR(StudentQuantile(10), 2.228, 5e-4);
  EXPECT_NEAR(StudentQuantile(30), 2.042, 5e-4);
  EXPECT_NEAR(StudentQuantile(1e9), 1.959963984540054, 1e-8);
}

}  // namespace
}  // namespace warmjoint

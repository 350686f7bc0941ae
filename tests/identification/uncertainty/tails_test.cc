// Exact tails against closed forms, and against SciPy 1.15.3 (Cephes and Boost through its own
// builds): scipy.stats.f.sf, t.isf, t.sf, norm.isf, printed by repr.
#include "identification/uncertainty/tails.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace warmjoint {
namespace {

// both sides keep about 1e-14 of a value; far tails lose a digit or two
constexpr double kClose = 1e-12;

#define EXPECT_CLOSE(value, expected) EXPECT_NEAR(value, expected, kClose*(expected))

TEST(StudentQuantile, AgreesWithClosedForms) {
  for (const double level : {0.5, 0.9, 0.95, 0.99, 0.999}) {
    EXPECT_CLOSE(StudentQuantile(1, level), std::tan(level * std::numbers::pi / 2));
    EXPECT_CLOSE(StudentQuantile(2, level), level * std::sqrt(2 / (1 - level * level)));
    EXPECT_CLOSE(StudentQuantile(1e300, level), ZOf(1 - level));
  }
}

TEST(StudentQuantile, AgreesWithSciPy) {
  EXPECT_CLOSE(StudentQuantile(3, 0.95), 3.1824463052842638);
  EXPECT_CLOSE(StudentQuantile(5, 0.95), 2.5705818356363146);
  // SciPy has 2.2281388519649385, which leaves 1.8e-12 of the closed form for even freedoms
  EXPECT_CLOSE(StudentQuantile(10, 0.95), 2.2281388519862739);
  EXPECT_CLOSE(StudentQuantile(28, 0.99), 2.763262455461066);
}

TEST(StudentQuantile, CountsLessThanOneFreedomAsOne) {
  EXPECT_EQ(StudentQuantile(0, 0.95), StudentQuantile(1, 0.95));
}

TEST(PValueOfStudent, IsTheShareBeyondToBothSides) {
  // Cauchy for one degree of freedom
  EXPECT_CLOSE(PValueOfStudent(3, 1), 1 - 2 / std::numbers::pi * std::atan(3));
  EXPECT_CLOSE(PValueOfStudent(-6, 7), 0.0005422583420028096);
  EXPECT_CLOSE(PValueOfStudent(StudentQuantile(12, 0.95), 12), 0.05);
  EXPECT_EQ(PValueOfStudent(std::numeric_limits<double>::infinity(), 3), 0);
}

TEST(PValueOfNormal, AgreesWithSciPy) {
  EXPECT_EQ(PValueOfNormal(0), 1);
  EXPECT_CLOSE(PValueOfNormal(-5), 5.733031437583866e-07);
  EXPECT_CLOSE(PValueOfNormal(30), 9.813427854295816e-198);
}

TEST(ZOf, IsTheInverseOfTheNormalsTails) {
  EXPECT_CLOSE(ZOf(0.05), 1.9599639845400545);
  for (const double z : {0.1, 1.0, 3.5, 5.0, 12.0, 30.0}) EXPECT_CLOSE(ZOf(PValueOfNormal(z)), z);
  EXPECT_EQ(ZOf(1), 0);
  EXPECT_EQ(ZOf(0), std::numeric_limits<double>::infinity());
}

TEST(PValueOfF, AgreesWithClosedForms) {
  // two numerator freedoms: (1 + 2 f / n)^(-n/2); two denominator freedoms: 1 - (1 + 2/(m f))^(-m/2)
  for (const double f : {0.1, 1.0, 4.0, 30.0}) {
    EXPECT_CLOSE(PValueOfF(f, 2, 28), std::pow(1 + 2 * f / 28, -14));
    EXPECT_CLOSE(PValueOfF(f, 6, 2), 1 - std::pow(1 + 2 / (6 * f), -3));
    // one numerator degree of freedom: t squared
    EXPECT_CLOSE(PValueOfF(f, 1, 9), PValueOfStudent(std::sqrt(f), 9));
  }
  EXPECT_EQ(PValueOfF(0, 3, 5), 1);
  EXPECT_EQ(PValueOfF(std::numeric_limits<double>::infinity(), 3, 5), 0);
}

TEST(PValueOfF, AgreesWithSciPy) {
  EXPECT_CLOSE(PValueOfF(10.04, 1, 10), 0.01001150397864202);
  EXPECT_CLOSE(PValueOfF(2.96, 6, 120), 0.009913405700818336);
  EXPECT_CLOSE(PValueOfF(30, 4, 28), 9.295289048992513e-10);
  EXPECT_CLOSE(PValueOfF(45, 4, 28), 8.416020415806942e-12);
  EXPECT_CLOSE(PValueOfF(120, 3, 500), 1.520766611025198e-58);
}

TEST(PValues, ShowNothingOfWhatIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(PValueOfStudent(nan, 9), 1);
  EXPECT_EQ(PValueOfF(nan, 3, 5), 1);
}

}  // namespace
}  // namespace warmjoint

// How unlikely a statistic is by chance, and the quantiles of which intervals are made. Exact, by Boost.Math.
//
// p-values are probabilities, under chance alone, of a statistic at least as extreme as the one
// given: one-sided for F, two-sided for the normal and Student's t. A z-score is always the number of
// standard deviations that a normal variable exceeds to either side with that probability:
// p = 4.6e-4, one in 2150, is z = 3.5. A statistic that is not a number, 0/0 where two things are equal to the
// last digit, shows nothing, so its p is 1.
#pragma once

namespace warmjoint {

/// Share of the cases in which reported intervals hold the truth.
inline constexpr double kIntervalLevel = 0.95;
inline constexpr double kNormal95 = 1.96;  // why: 95 % of a normal variable

/// What chi-squared of one degree of freedom exceeds by chance in 1 % of the cases.
inline constexpr double kNoChance = 6.63;  // why 6.63: by definition

/// P(|N| >= |z|) of a standard normal N; 0 to 1.
double PValueOfNormal(double z);

/// The z >= 0 with PValueOfNormal(z) = p. p: 0 to 1; 0 gives infinity.
double ZOf(double p);

/// P(|T| >= |t|) of Student's t; 0 to 1. degrees_of_freedom > 0.
double PValueOfStudent(double t, double degrees_of_freedom);

/// P(|T| <= quantile) = level: value +- quantile * std holds the truth in that share of the cases.
/// degrees_of_freedom: samples less parameters; below 1 counts as 1. level: above 0, below 1.
double StudentQuantile(double degrees_of_freedom, double level);

/// P(F >= f) of Fisher's F; 0 to 1. f >= 0, may be infinite; m, n > 0: degrees of freedom of
/// numerator and denominator.
double PValueOfF(double f, double m, double n);

/// How many deviations an interval reaches beyond both ends of a range, so that it holds the true value, at either end or
/// between them, with a probability of 95 %: the C of
///
///     Phi(C + range) - Phi(-C) = 0.95,
///
/// 1.96 where both ends are one, down to 1.64 where they are far from each other, since the truth can then be missed on one side only.
/// range: of the ends from each other, in deviations, >= 0. Source: Imbens, Manski, Confidence Intervals for Partially
/// Identified Parameters, Econometrica 72 (2004), 1845.
double ReachBeyondEnds(double range);

}  // namespace warmjoint

// The quantile that turns standard deviations into 95 % intervals.
#pragma once

namespace warmjoint::inline identification {

/// 97.5 % quantile of Student's t: value +- quantile * std holds the truth in 95 % of the cases.
/// Cornish-Fisher expansion in 1/freedom (Abramowitz and Stegun 26.7.5), exact for 1 and 2.
/// freedom: samples less parameters, at least 1.
double StudentQuantile(double freedom);

}  // namespace warmjoint::inline identification

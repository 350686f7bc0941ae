// Round numbers for axes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/report/draw/figure.h"

namespace warmjoint::report {

/// Ticks between the axis limits, at most about `wanted`: multiples of 1, 2 or 5 times a power of
/// ten, or decades (with 2 and 5 between where few decades are seen). An axis that brings its own
/// ticks keeps them.
std::vector<Tick> AxisTicks(const Axis& axis, int wanted);

/// Places of unlabelled grid lines of a logarithmic axis: 2 ... 9 times each decade.
std::vector<double> MinorTicks(const Axis& axis);

/// A number as a person writes it: true minus sign, and 5·10⁻⁵ below 0.001 or from 100 000 on.
/// decimals: digits after the point where no power of ten is used.
std::string NumberText(double value, int decimals);

/// The same with `digits` significant digits.
std::string SignificantText(double value, int digits = 3);

/// A unit as set in print: "N·m·s²/rad" for "N.m.s^2/rad".
std::string UnitText(std::string_view unit);

}  // namespace warmjoint::report

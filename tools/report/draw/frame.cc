#include "tools/report/draw/frame.h"

#include <algorithm>
#include <cmath>

namespace warmjoint::report {
namespace {

/// Far outside of every page, and still a number that it can hold.
double Near(double place) { return std::clamp(place, -1e4, 1e5); }

}  // namespace

double ShareOf(const Axis& axis, double value) {
  if (axis.scale == Scale::linear) return (value - axis.lower) / (axis.upper - axis.lower);
  return std::log(value / axis.lower) / std::log(axis.upper / axis.lower);
}

double ValueAt(const Axis& axis, double share) {
  if (axis.scale == Scale::linear) return axis.lower + share * (axis.upper - axis.lower);
  return axis.lower * std::pow(axis.upper / axis.lower, share);
}

double Frame::X(double value) const {
  return Near(area_.left + ShareOf(x_, value) * area_.width());
}

double Frame::Y(double value) const {
  return Near(area_.bottom - ShareOf(y_, value) * area_.height());
}

}  // namespace warmjoint::report

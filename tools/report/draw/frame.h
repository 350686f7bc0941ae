// From data to places on the page, and back.
#pragma once

#include "tools/report/draw/figure.h"
#include "tools/report/draw/place.h"

namespace warmjoint::report {

/// Share of the axis at a value: 0 at its lower end, 1 at its upper one.
double ShareOf(const Axis& axis, double value);

/// The value at a share of the axis.
double ValueAt(const Axis& axis, double share);

/// The axes of a plot around a rectangle of the page.
class Frame {
 public:
  Frame(const Plot& plot, const Rectangle& area) : x_(plot.x), y_(plot.y), area_(area) {}

  const Rectangle& area() const { return area_; }
  double X(double value) const;
  double Y(double value) const;
  Point Put(double x, double y) const { return {X(x), Y(y)}; }

  /// Data at a point of the page.
  double ValueX(Point p) const { return ValueAt(x_, (p.x - area_.left) / area_.width()); }
  double ValueY(Point p) const { return ValueAt(y_, (area_.bottom - p.y) / area_.height()); }

 private:
  const Axis& x_;
  const Axis& y_;
  const Rectangle& area_;
};

}  // namespace warmjoint::report

// Places on a page, in points, x to the right, y downwards.
#pragma once

namespace warmjoint::report {

struct Point {
  double x = 0;
  double y = 0;
};

struct Extent {
  double width = 0;
  double height = 0;
};

struct Rectangle {
  double left = 0, top = 0, right = 0, bottom = 0;

  double width() const { return right - left; }
  double height() const { return bottom - top; }
};

}  // namespace warmjoint::report

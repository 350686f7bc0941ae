#include "tools/report/draw/pen.h"

namespace warmjoint::report {

void Pen::Remember(const std::string& text, const Type& type, const Rectangle& place) {
  if (!CanSet(text, type)) drawn_.unreadable.push_back(text);
  drawn_.texts.push_back({text, place});
}

Extent Pen::Write(const std::string& text, const Type& type, Point at, Rgb colour, double wrap) {
  double baseline = at.y + BaselineOf(type);
  for (const std::string& line : LinesOf(text, type, wrap)) {
    canvas_.Write({line, type, {at.x, baseline}, colour});
    baseline += type.size;
  }
  const Extent extent = Measure(text, type, wrap);
  Remember(text, type, {at.x, at.y, at.x + extent.width, at.y + extent.height});
  return extent;
}

Extent Pen::WriteCentred(const std::string& text, const Type& type, Point top, Rgb colour,
                         double wrap) {
  double baseline = top.y + BaselineOf(type);
  for (const std::string& line : LinesOf(text, type, wrap)) {
    canvas_.Write({line, type, {top.x - Measure(line, type).width / 2, baseline}, colour});
    baseline += type.size;
  }
  // where the words stand, and whether the typeface has them all, is kept
  const Extent extent = Measure(text, type, wrap);
  Remember(text, type,
           {top.x - extent.width / 2, top.y, top.x + extent.width / 2, top.y + extent.height});
  return extent;
}

void Pen::WriteUpwards(const std::string& text, const Type& type, Point middle, Rgb colour) {
  const Extent extent = Measure(text, type);
  // level words turned about their middle
  const Rectangle place{middle.x - extent.height / 2, middle.y - extent.width / 2,
                        middle.x + extent.height / 2, middle.y + extent.width / 2};
  canvas_.Write({text, type, {place.left + BaselineOf(type), place.bottom}, colour, true});
  Remember(text, type, place);
}

}  // namespace warmjoint::report

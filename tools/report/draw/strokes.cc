#include "tools/report/draw/strokes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace warmjoint::report {
namespace {

/// Lengths of mark and gap, points.
std::pair<float, float> Pattern(Dash dash, float width) {
  return dash == Dash::dashed ? std::pair(5.0f + width, 3.5f + width)
                              : std::pair(width, 2.0f + width);
}

}  // namespace

void StrokePath(ImDrawList& list, const std::vector<ImVec2>& path, ImU32 colour, float width,
                Dash dash) {
  if (path.size() < 2) return;
  if (dash == Dash::solid) {
    list.AddPolyline(path.data(), static_cast<int>(path.size()), colour, 0, width);
    return;
  }

  // walk along the path, switching between mark and gap
  const auto [mark, gap] = Pattern(dash, width);
  bool on = true;
  float left = mark;
  for (std::size_t i = 1; i < path.size(); ++i) {
    ImVec2 from = path[i - 1];
    float rest = std::hypot(path[i].x - from.x, path[i].y - from.y);
    while (rest > 0) {
      const float step = std::min(left, rest);
      const float share = step / rest;
      const ImVec2 to{from.x + share * (path[i].x - from.x), from.y + share * (path[i].y - from.y)};
      if (on) StrokeLine(list, from, to, colour, width);
      from = to;
      rest -= step;
      left -= step;
      if (left <= 0) {
        on = !on;
        left = on ? mark : gap;
      }
    }
  }
}

void StrokeLine(ImDrawList& list, ImVec2 from, ImVec2 to, ImU32 colour, float width) {
  const ImVec2 ends[] = {from, to};
  list.AddPolyline(ends, 2, colour, 0, width);
}

void StampMarker(ImDrawList& list, ImVec2 c, Marker marker, float r, ImU32 colour) {
  const float s = 0.88f * r;  // squares and triangles of the same weight as circles
  switch (marker) {
    case Marker::circle:
      // the corners of eight are a tenth of a pixel off where the radius is a point
      return list.AddCircleFilled(c, r, colour, r < 1.5f ? 8 : 16);
    case Marker::square:
      return list.AddRectFilled({c.x - s, c.y - s}, {c.x + s, c.y + s}, colour);
    case Marker::diamond:
      return list.AddQuadFilled({c.x, c.y - 1.3f * r}, {c.x + 1.3f * r, c.y}, {c.x, c.y + 1.3f * r},
                                {c.x - 1.3f * r, c.y}, colour);
    case Marker::up:
      return list.AddTriangleFilled({c.x, c.y - 1.3f * r}, {c.x + 1.2f * r, c.y + 0.8f * r},
                                    {c.x - 1.2f * r, c.y + 0.8f * r}, colour);
    case Marker::down:
      return list.AddTriangleFilled({c.x, c.y + 1.3f * r}, {c.x - 1.2f * r, c.y - 0.8f * r},
                                    {c.x + 1.2f * r, c.y - 0.8f * r}, colour);
    case Marker::cross:
      StrokeLine(list, {c.x - r, c.y - r}, {c.x + r, c.y + r}, colour, 0.6f * r);
      return StrokeLine(list, {c.x - r, c.y + r}, {c.x + r, c.y - r}, colour, 0.6f * r);
  }
}

}  // namespace warmjoint::report

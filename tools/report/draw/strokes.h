// Marks on ImGui's draw list, in points on the page.
#pragma once

#include <imgui.h>

#include <vector>

#include "tools/report/draw/figure.h"

namespace warmjoint::report {

/// A solid, dashed or dotted line through the points.
void StrokePath(ImDrawList& list, const std::vector<ImVec2>& path, ImU32 colour, float width,
                Dash dash);

/// A straight line whose middle runs through both points (ImGui's own AddLine is half a point off).
void StrokeLine(ImDrawList& list, ImVec2 from, ImVec2 to, ImU32 colour, float width);

/// A filled marker; radius in points.
void StampMarker(ImDrawList& list, ImVec2 centre, Marker marker, float radius, ImU32 colour);

}  // namespace warmjoint::report

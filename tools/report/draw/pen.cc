#include "tools/report/draw/pen.h"

#include <imgui_internal.h>

#include <algorithm>
#include <utility>

namespace warmjoint::report {

ImU32 Pen::Paint(Rgb colour, double opacity) {
  return IM_COL32(colour.red, colour.green, colour.blue, static_cast<int>(255 * opacity + 0.5));
}

ImVec2 Pen::Measure(const std::string& text, const Type& type, float wrap) const {
  return Font(type)->CalcTextSizeA(type.size, FLT_MAX, wrap, text.data(),
                                   text.data() + text.size());
}

void Pen::CheckGlyphs(const std::string& text, const Type& type) {
  const char* end = text.data() + text.size();
  for (const char* at = text.data(); at < end;) {
    unsigned int character = 0;
    at += ImTextCharFromUtf8(&character, at, end);
    const bool known =
        character != IM_UNICODE_CODEPOINT_INVALID &&
        (character < ' ' || Font(type)->IsGlyphInFont(static_cast<ImWchar>(character)));
    if (!known) {
      drawn_.unreadable.push_back(text);
      return;
    }
  }
}

ImVec2 Pen::Write(ImDrawList& list, const std::string& text, const Type& type, ImVec2 at,
                  Rgb colour, float wrap) {
  CheckGlyphs(text, type);
  const ImVec2 extent = Measure(text, type, wrap);
  list.AddText(Font(type), type.size, at, Paint(colour), text.data(), text.data() + text.size(),
               wrap);
  drawn_.texts.push_back({text, {at.x, at.y, at.x + extent.x, at.y + extent.y}});
  return extent;
}

ImVec2 Pen::WriteCentred(ImDrawList& list, const std::string& text, const Type& type, ImVec2 top,
                         Rgb colour, float wrap) {
  CheckGlyphs(text, type);
  const ImVec2 extent = Measure(text, type, wrap);
  const float width = wrap > 0 ? wrap : FLT_MAX;
  const char* end = text.data() + text.size();
  float y = top.y;
  for (const char* at = text.data(); at < end; y += type.size) {
    // up to the line's own end, or to where it must break
    const char* line_end = std::find(at, end, '\n');
    const char* stop = Font(type)->CalcWordWrapPosition(type.size, at, line_end, width);
    const float reach = Font(type)->CalcTextSizeA(type.size, FLT_MAX, 0, at, stop).x;
    list.AddText(Font(type), type.size, {top.x - reach / 2, y}, Paint(colour), at, stop);
    at = stop;
    while (at < end && (*at == ' ' || *at == '\n')) ++at;
  }
  drawn_.texts.push_back(
      {text, {top.x - extent.x / 2, top.y, top.x + extent.x / 2, top.y + extent.y}});
  return extent;
}

void Pen::WriteUpwards(ImDrawList& list, const std::string& text, const Type& type, ImVec2 middle,
                       Rgb colour) {
  CheckGlyphs(text, type);
  const ImVec2 extent = Measure(text, type);
  // set it level, then turn its corners about the middle
  const int first = list.VtxBuffer.Size;
  const ImVec2 corner{middle.x - extent.x / 2, middle.y - extent.y / 2};
  list.PushClipRect({-1e4f, -1e4f}, {1e4f, 1e4f});
  list.AddText(Font(type), type.size, corner, Paint(colour), text.data(),
               text.data() + text.size());
  list.PopClipRect();
  for (int i = first; i < list.VtxBuffer.Size; ++i) {
    ImVec2& vertex = list.VtxBuffer[i].pos;
    vertex = {middle.x + (vertex.y - middle.y), middle.y - (vertex.x - middle.x)};
  }
  drawn_.texts.push_back({text,
                          {middle.x - extent.y / 2, middle.y - extent.x / 2,
                           middle.x + extent.y / 2, middle.y + extent.x / 2}});
}

}  // namespace warmjoint::report

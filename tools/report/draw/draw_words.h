// Panels that are no plots: paragraphs, tables, pictures.
#pragma once

#include "tools/report/draw/figure.h"
#include "tools/report/draw/pen.h"

namespace warmjoint::report {

/// Points that they take; width: of the panel.
double HeightOf(const Words& words, double width);
double HeightOf(const Table& table);

void DrawWords(Pen& pen, const Words& words, const Rectangle& area);
void DrawTable(Pen& pen, const Table& table, const Rectangle& area);
void DrawPicture(Pen& pen, const Picture& picture, const Rectangle& area);

}  // namespace warmjoint::report

#include "tools/report/figures/fit_page.h"

#include <fmt/core.h>

#include <algorithm>

#include "tools/report/draw/draw_figure.h"
#include "tools/report/draw/ticks.h"
#include "tools/report/figures/fit_panels.h"

namespace warmjoint::report {
namespace {

constexpr int kColumns = 6;
constexpr int kHead = 65;                        // points, title and margins
constexpr int kPlotRow = 200;                    // points
constexpr int kWordsRow = 150;                   // points
constexpr int kTableHead = 50, kTableRow = 19;   // points
constexpr int kWordsHead = 30, kWordsLine = 13;  // points
constexpr size_t kLettersInHalf = 72;            // of a line of words over half the page

/// The page, and the row that is filled next.
class Page {
 public:
  explicit Page(Figure& figure) : figure_(figure) {
    figure_.columns.assign(kColumns, 1);
    figure_.rows.clear();
    figure_.height = kHead;
  }

  /// Begins a row. height: points.
  void Row(int height) {
    figure_.rows.push_back(height);
    figure_.height += height + static_cast<int>(size::kGap);
  }

  template <typename Content>
  void Add(const std::string& title, const Content& content, int column, int span) {
    Panel panel{title, content};
    panel.row = static_cast<int>(figure_.rows.size()) - 1;
    panel.column = column;
    panel.column_span = span;
    figure_.panels.push_back(panel);
  }

 private:
  Figure& figure_;
};

std::string Finding(const FitView& view) {
  std::string text = VerdictSentence(view);
  if (view.estimate.metrics) {
    text += fmt::format("; fit {:.1f} %, RMSE {} {}", view.estimate.metrics->fit,
                        SignificantText(view.estimate.metrics->rmse), view.torque_unit);
  }
  return text + ".";
}

/// Points that words need, with some to spare. letters: of a line.
int HeightOf(const Words& words, size_t letters) {
  size_t height = kWordsHead;
  for (const Words::Paragraph& paragraph : words.paragraphs) {
    const size_t lines = paragraph.text.size() / letters + 1;
    height += lines * kWordsLine + static_cast<size_t>(size::kPad);
  }
  return static_cast<int>(height);
}

void AddEvidence(Page& page, const FitView& view) {
  page.Row(kPlotRow);
  page.Add("Residuals over time, with their mean", ResidualsOver(view, Against::time), 0, 3);
  page.Add("Correlation of residuals over lag; within the dashed lines if white",
           ResidualMemory(view), 3, 3);
  page.Row(kPlotRow);
  if (view.warms()) {
    page.Add("Residuals over position", ResidualsOver(view, Against::position), 0, 2);
    page.Add("Residuals over velocity", ResidualsOver(view, Against::velocity), 2, 2);
    page.Add("Residuals over warmth", ResidualsOver(view, Against::energy), 4, 2);
  } else {
    page.Add("Residuals over position", ResidualsOver(view, Against::position), 0, 3);
    page.Add("Residuals over velocity", ResidualsOver(view, Against::velocity), 3, 3);
  }
}

}  // namespace

Figure MakeFitPage(const FitView& view) {
  Figure figure;
  figure.name = "fit";
  figure.title = view.source;
  figure.subtitle = fmt::format("identified by {}", view.estimate.identifier);
  figure.finding = Finding(view);
  figure.width = 960;

  Page page(figure);
  const bool has_numbers = !view.estimate.parameters.empty();
  const Words verdict = VerdictOf(view);
  page.Row(std::max({kWordsRow, HeightOf(verdict, (has_numbers ? 1 : 2) * kLettersInHalf),
                     kTableHead + kTableRow * static_cast<int>(view.estimate.parameters.size())}));
  page.Add("Verdict", verdict, 0, has_numbers ? 3 : kColumns);
  if (has_numbers) page.Add("Parameters", ParametersOf(view), 3, 3);

  page.Row(kPlotRow + 25);
  page.Add(view.has_fit ? "Level of friction over time" : "Torque in the direction of motion",
           LevelOverTime(view), 0, kColumns);

  const Window cold = ColdWindow(view), warm = WarmWindow(view);
  const auto limits = TorqueLimits(view, cold, warm);
  page.Row(kPlotRow);
  page.Add("The first segments", CloseUp(view, cold, limits), 0, 3);
  page.Add("The last segments", CloseUp(view, warm, limits), 3, 3);

  page.Row(kPlotRow + 25);
  page.Add("Friction over velocity", FrictionCurve(view), 0, view.warms() ? 3 : kColumns);
  if (view.warms()) page.Add("Warm-up", WarmUpCurve(view), 3, 3);
  if (view.has_fit) AddEvidence(page, view);

  return figure;
}

void WriteFitPage(const Measurements& measurements, const Selection& selection,
                  const Estimate& estimate, const std::string& path) {
  const Figure page = MakeFitPage(MakeFitView(measurements, selection, estimate));
  Canvas canvas;
  WritePng(DrawFigure(canvas, page).image, page.finding, path);
}

}  // namespace warmjoint::report

// The story of one recording on one page.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>

#include "tools/figures/axes.h"
#include "tools/figures/estimate_figures.h"
#include "tools/figures/fit_panels.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

constexpr int kColumns = 6;
constexpr double kPlotRow = 200, kTallRow = 225;  // points
constexpr double kWordsRow = 0;                   // as high as its words

/// Adds a panel to the last row. span: of columns.
Panel& AddSpan(Figure& page, const std::string& title, const Content& content, int column,
               int span) {
  const int row = static_cast<int>(page.rows.size()) - 1;
  return page.panels.emplace_back(Panel{title, content, row, column, 1, span});
}

std::string Finding(const FitView& view) {
  std::string text = VerdictSentence(view);
  if (view.estimate.metrics) {
    text += fmt::format("; fit {:.1f} %, RMSE {} {}", view.estimate.metrics->fit,
                        SignificantText(view.estimate.metrics->rmse), view.torque_unit);
  }
  return text + ".";
}

/// What the residual is looked at against to see what a test for lack of fit found.
SeenOver OverOf(const Diagnostic& diagnostic, const FitView& view) {
  // of a test that this program does not know: time
  const LackOfFitTest* test = FindLackOfFitTest(diagnostic.test);
  const SeenOver over = test ? test->over : SeenOver::time;
  return over == SeenOver::energy && !view.warms() ? SeenOver::time : over;
}

/// Tests that found something, by the panel that shows it.
std::map<SeenOver, std::vector<std::string>> Deciding(const FitView& view) {
  std::map<SeenOver, std::vector<std::string>> deciding;
  for (const Diagnostic& diagnostic : view.estimate.diagnostics) {
    if (diagnostic.rejected) {
      deciding[OverOf(diagnostic, view)].push_back(diagnostic.test);
    }
  }
  return deciding;
}

/// Where the test shows that found the most; nothing where none found anything.
std::optional<SeenOver> Strongest(const FitView& view) {
  std::optional<SeenOver> strongest;
  double largest = -1;
  for (const Diagnostic& diagnostic : view.estimate.diagnostics) {
    if (!diagnostic.rejected || diagnostic.effect <= largest) continue;
    largest = diagnostic.effect;
    strongest = OverOf(diagnostic, view);
  }
  return strongest;
}

/// A panel of residuals that names the tests which found something in it; the one that found the most
/// is framed.
void AddResiduals(Figure& page, const FitView& view, SeenOver against, const char* title,
                  int column, int span) {
  Panel& panel = AddSpan(page, title, ResidualsOver(view, against), column, span);
  const auto deciding = Deciding(view);
  const auto found = deciding.find(against);
  // no test found anything in these residuals
  if (found == deciding.end()) return;
  // the title names the tests that found something here
  std::string tests = fmt::format("{}", fmt::join(found->second, ", "));
  std::replace(tests.begin(), tests.end(), '_', ' ');
  // a frame where the strongest finding decided the verdict
  const bool decided = Strongest(view) == against && view.estimate.status != Status::ok;
  panel.title += fmt::format(": {} {}", decided ? "decided by" : "shows", tests);
  if (decided) panel.frame = Hue::vermilion;
}

void AddEvidence(Figure& page, const FitView& view) {
  // in time: whether residuals drift, and how long they stay alike
  page.rows.push_back(kPlotRow);
  AddResiduals(page, view, SeenOver::time, "Residuals over time, with their median", 0, 3);
  AddSpan(page, "Correlation of residuals over lag; within the dashed lines if white",
          ResidualMemory(view), 3, 3);
  // over what the joint does: its place, its speed, its warmth
  page.rows.push_back(kPlotRow);
  const int span = view.warms() ? 2 : 3;
  AddResiduals(page, view, SeenOver::position, "Residuals over position", 0, span);
  AddResiduals(page, view, SeenOver::velocity, "Residuals over velocity", span, span);
  if (view.warms()) AddResiduals(page, view, SeenOver::energy, "Residuals over warmth", 4, 2);
  // over the motor's angle only where a test found something there
  if (Deciding(view).contains(SeenOver::motor_angle) && view.motor_angle.size() > 0) {
    page.rows.push_back(kPlotRow);
    AddResiduals(page, view, SeenOver::motor_angle, "Residuals over motor angle", 0, kColumns);
  }
}

}  // namespace

Figure MakeFitPage(const FitView& view) {
  Figure page =
      WithoutPanels({"fit", view.source, fmt::format("identified by {}", view.estimate.identifier),
                     Finding(view)},
                    kColumns);
  // first what came out: verdict and numbers
  const bool has_numbers = !view.estimate.parameters.empty();
  page.rows.push_back(kWordsRow);
  AddSpan(page, "Verdict", VerdictOf(view), 0, has_numbers ? 3 : kColumns);
  if (has_numbers)
    AddSpan(page, view.is_void() ? "Parameters (void)" : "Parameters", ParametersOf(view), 3, 3);

  // the level of friction over the whole recording
  page.rows.push_back(kTallRow);
  AddSpan(page, view.has_fit ? "Level of friction over time" : "Torque in the direction of motion",
          LevelOverTime(view), 0, kColumns);

  // begin and end of the recording close up, over the same torques
  const Window cold = ColdWindow(view), warm = WarmWindow(view);
  const Axis torque = TorqueAxis(view, cold, warm);
  page.rows.push_back(kPlotRow);
  AddSpan(page, view.selection.segments.empty() ? "The begin" : "The first segments",
          CloseUp(view, cold, torque), 0, 3);
  AddSpan(page, view.selection.segments.empty() ? "The end" : "The last segments",
          CloseUp(view, warm, torque), 3, 3);

  // the law over velocity, and the warming beside it
  page.rows.push_back(kTallRow);
  AddSpan(page, "Friction over velocity", FrictionCurve(view), 0, view.warms() ? 3 : kColumns);
  if (view.warms()) AddSpan(page, "Warm-up", WarmUpCurve(view), 3, 3);
  if (view.has_fit) AddEvidence(page, view);

  return page;
}

}  // namespace warmjoint::figures

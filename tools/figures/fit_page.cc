// The story of one recording on one page.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>

#include "models/foundation/atomic_file.h"
#include "tools/figures/estimate_figures.h"
#include "tools/figures/fit_panels.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

constexpr int kColumns = 6;
constexpr double kPlotRow = 200, kTallRow = 225;  // points
constexpr double kWordsRow = 0;                   // as high as its words

/// The page, and the row that is filled next.
class Page {
 public:
  explicit Page(Figure& figure) : figure_(figure) {
    figure_.columns.assign(kColumns, 1);
    figure_.rows.clear();
    figure_.height = 0;  // what the rows need
  }

  /// Begins a row. height: points.
  void Row(double height) { figure_.rows.push_back(height); }

  template <typename Content>
  void Add(const std::string& title, const Content& content, int column, int span) {
    Panel panel{title, content};
    panel.row = static_cast<int>(figure_.rows.size()) - 1;
    panel.column = column;
    panel.column_span = span;
    figure_.panels.push_back(panel);
  }

  /// Frames the panel that was added last.
  void Frame(Hue hue) { figure_.panels.back().frame = hue; }

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
void AddResiduals(Page& page, const FitView& view, SeenOver against, const char* title, int column,
                  int span) {
  const auto deciding = Deciding(view);
  const auto found = deciding.find(against);
  // no test found anything in these residuals
  if (found == deciding.end()) {
    return page.Add(title, ResidualsOver(view, against), column, span);
  }
  // the title names the tests that found something here
  std::string tests = fmt::format("{}", fmt::join(found->second, ", "));
  std::replace(tests.begin(), tests.end(), '_', ' ');
  // a frame where the strongest finding decided the verdict
  const bool decided = Strongest(view) == against && view.estimate.status != Status::ok;
  page.Add(fmt::format("{}: {} {}", title, decided ? "decided by" : "shows", tests),
           ResidualsOver(view, against), column, span);
  if (decided) page.Frame(Hue::vermilion);
}

void AddEvidence(Page& page, const FitView& view) {
  // in time: whether residuals drift, and how long they stay alike
  page.Row(kPlotRow);
  AddResiduals(page, view, SeenOver::time, "Residuals over time, with their median", 0, 3);
  page.Add("Correlation of residuals over lag; within the dashed lines if white",
           ResidualMemory(view), 3, 3);
  // over what the joint does: its place, its speed, its warmth
  page.Row(kPlotRow);
  const int span = view.warms() ? 2 : 3;
  AddResiduals(page, view, SeenOver::position, "Residuals over position", 0, span);
  AddResiduals(page, view, SeenOver::velocity, "Residuals over velocity", span, span);
  if (view.warms()) AddResiduals(page, view, SeenOver::energy, "Residuals over warmth", 4, 2);
  // over the motor's angle only where a test found something there
  if (Deciding(view).contains(SeenOver::motor_angle) && view.motor_angle.size() > 0) {
    page.Row(kPlotRow);
    AddResiduals(page, view, SeenOver::motor_angle, "Residuals over motor angle", 0, kColumns);
  }
}

}  // namespace

Figure MakeFitPage(const FitView& view) {
  Figure figure;
  figure.name = "fit";
  figure.title = view.source;
  figure.subtitle = fmt::format("identified by {}", view.estimate.identifier);
  figure.finding = Finding(view);

  Page page(figure);
  // first what came out: verdict and numbers
  const bool has_numbers = !view.estimate.parameters.empty();
  page.Row(kWordsRow);
  page.Add("Verdict", VerdictOf(view), 0, has_numbers ? 3 : kColumns);
  if (has_numbers)
    page.Add(view.is_void() ? "Parameters (void)" : "Parameters", ParametersOf(view), 3, 3);

  // the level of friction over the whole recording
  page.Row(kTallRow);
  page.Add(view.has_fit ? "Level of friction over time" : "Torque in the direction of motion",
           LevelOverTime(view), 0, kColumns);

  // begin and end of the recording close up, over the same torques
  const Window cold = ColdWindow(view), warm = WarmWindow(view);
  const auto limits = TorqueLimits(view, cold, warm);
  page.Row(kPlotRow);
  page.Add(view.selection.segments.empty() ? "The begin" : "The first segments",
           CloseUp(view, cold, limits), 0, 3);
  page.Add(view.selection.segments.empty() ? "The end" : "The last segments",
           CloseUp(view, warm, limits), 3, 3);

  // the law over velocity, and the warming beside it
  page.Row(kTallRow);
  page.Add("Friction over velocity", FrictionCurve(view), 0, view.warms() ? 3 : kColumns);
  if (view.warms()) page.Add("Warm-up", WarmUpCurve(view), 3, 3);
  if (view.has_fit) AddEvidence(page, view);

  return figure;
}

}  // namespace warmjoint::figures

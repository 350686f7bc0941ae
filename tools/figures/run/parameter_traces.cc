// Parameters by iteration, as in the paper's Fig. 5.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "models/foundation/robust_noise.h"
#include "tools/board/statistics.h"
#include "tools/figures/axes.h"
#include "tools/figures/run/run_figures.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

/// The row with the longest trace, or nullptr.
const RunRow* LongestTrace(const RunView& run) {
  const RunRow* longest = nullptr;
  for (const RunRow& row : run.rows) {
    const auto length = row.trace.iteration.size();
    if (length > 1 && (!longest || length > longest->trace.iteration.size())) longest = &row;
  }
  return longest;
}

constexpr Eigen::Index kMostLines = 12;  // realizations that get a line each

/// Which part of the realizations a band holds, and how it looks.
struct Share {
  double outer;  // of them on each side of it
  const char* label;
  double opacity;  // alone, as in the legend
};
constexpr Share kShares[] = {{0.1, "middle 80 %", 0.15}, {0.25, "middle half", 0.5}};

/// Where the middle 80 % and the middle half of the realizations run.
void AddBands(Plot& plot, const Eigen::VectorXd& iteration, const Eigen::MatrixXd& values) {
  for (const auto& [outer, label, opacity] : kShares) {
    Band band{iteration, Eigen::VectorXd(iteration.size()), Eigen::VectorXd(iteration.size()),
              opacity};
    for (Eigen::Index k = 0; k < iteration.size(); ++k) {
      const std::vector<double> sorted = SortedFinite(values.col(k));
      band.lower[k] = sorted.empty() ? std::nan("") : Quantile(sorted, outer);
      band.upper[k] = sorted.empty() ? std::nan("") : Quantile(sorted, 1 - outer);
    }
    plot.series.push_back({label, Hue::grey, band});
  }
}

/// Lines of all realizations as one, with gaps between them. values: [R x K].
Line AllRealizations(const Eigen::VectorXd& x, const Eigen::MatrixXd& values) {
  const Eigen::Index rows = values.rows(), columns = values.cols() + 1;
  Line line{Eigen::VectorXd::Constant(rows * columns, std::nan("")),
            Eigen::VectorXd::Constant(rows * columns, std::nan("")), 0.7};
  for (Eigen::Index row = 0; row < rows; ++row) {
    line.x.segment(row * columns, x.size()) = x;
    line.y.segment(row * columns, x.size()) = values.row(row);
  }
  return line;
}

/// Limits that hold the middle 80 % of the realizations wherever one looks on the axis, and the
/// truth: single wild ones leave. values: [R x K].
std::pair<double, double> LimitsOf(const Axis& axis, const Eigen::VectorXd& iteration,
                                   const Eigen::MatrixXd& values, const Eigen::VectorXd& truth) {
  std::vector<Eigen::VectorXd> shown{truth};
  for (Eigen::Index k = 0; k < values.cols(); ++k) {
    if (iteration[k] < axis.lower) continue;
    const std::vector<double> sorted = SortedFinite(values.col(k));
    if (sorted.empty()) continue;
    shown.push_back(Eigen::Vector2d(Quantile(sorted, 0.1), Quantile(sorted, 0.9)));
  }
  return RangeOf(shown);
}

Plot PanelOf(const RunRow& row, const ParameterColumn& column, const Eigen::MatrixXd& values) {
  const Eigen::VectorXd& iteration = row.trace.iteration;
  const Hue hue = IdentifierHue(row.identifier);
  // the middle of the traces, and of the truths where they differ
  const QuartileCurve middle = QuartilesOf(iteration, values);
  const double truth = MedianOfKnown(column.truth);

  Plot plot;
  // many traces become bands, few are drawn one by one
  if (values.rows() > kMostLines) {
    AddBands(plot, iteration, values);
  } else {
    plot.series.push_back({"realizations", Hue::grey, AllRealizations(iteration, values)});
  }
  plot.series.push_back({"median", hue, Line{iteration, middle.median, 2.2}});
  plot.series.push_back({"truth", Hue::text, LevelLine{truth}});
  plot.x = IterationAxis(iteration[0], iteration.tail(1)[0]);
  // the axis reaches over most of the traces and the truth
  const auto [lower, upper] = LimitsOf(plot.x, iteration, values, column.truth);
  const std::string unit = column.unit.empty() ? "" : fmt::format(" ({})", column.unit);
  plot.y = LinearAxis(SymbolOf(column.name) + unit, {Eigen::Vector2d(lower, upper)});
  return plot;
}

}  // namespace

std::optional<Figure> ParameterTraces(const RunView& run) {
  const RunRow* row = LongestTrace(run);
  if (!row) return std::nullopt;

  const char* drawn = row->trace.npe.rows() > kMostLines ? "bands hold most of their traces"
                                                         : "each thin line is one";
  Figure figure = WithoutPanels(
      {"parameters_by_iteration", fmt::format("Parameters by iteration: {}", row->label),
       RunSubtitle(run, drawn), "Medians after the last iteration:"},
      2);
  // a panel for each parameter that the identifier iterates on
  for (const ParameterColumn& column : row->parameters) {
    const auto& names = row->trace.names;
    const auto found = std::find(names.begin(), names.end(), column.name);
    if (found == names.end()) continue;
    const Eigen::MatrixXd& values =
        row->trace.parameters[static_cast<std::size_t>(found - names.begin())];
    if (!values.array().isFinite().any()) continue;
    AddPanel(figure, NameWithSymbol(column.name), PanelOf(*row, column, values), 1);

    // where its median ended, beside the truth
    figure.finding += fmt::format(" {} {} (truth {}),", column.name,
                                  SignificantText(MedianOfKnown(values.col(values.cols() - 1))),
                                  SignificantText(MedianOfKnown(column.truth)));
  }
  if (figure.panels.empty()) return std::nullopt;
  figure.finding.back() = '.';
  figure.height = 80 + 250 * static_cast<int>(figure.rows.size());
  return figure;
}

}  // namespace warmjoint::figures

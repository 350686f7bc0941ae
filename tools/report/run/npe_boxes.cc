#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "tools/board/statistics.h"
#include "tools/report/draw/ticks.h"
#include "tools/report/figures/axes.h"
#include "tools/report/run/quartiles.h"
#include "tools/report/run/run_figures.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint::report {
namespace {

/// Whiskers from the 5 % to the 95 % quantile.
Box BoxOf(double x, const Eigen::VectorXd& values) {
  // finite errors in their order
  std::vector<double> sorted;
  for (double value : values) {
    if (std::isfinite(value)) sorted.push_back(value);
  }
  std::sort(sorted.begin(), sorted.end());
  // quartiles as the box, the middle 90 % between the whiskers
  Box box{x,
          Quantile(sorted, 0.05),
          Quantile(sorted, 0.25),
          Quantile(sorted, 0.5),
          Quantile(sorted, 0.75),
          Quantile(sorted, 0.95),
          {}};
  // errors beyond the whiskers are shown one by one
  std::vector<double> outliers;
  for (double value : sorted) {
    if (value < box.lower || value > box.upper) outliers.push_back(value);
  }
  box.outliers = Eigen::Map<const Eigen::VectorXd>(outliers.data(),
                                                   static_cast<Eigen::Index>(outliers.size()));
  return box;
}

/// Label of a category, with what failed below it.
std::string LabelOf(const RunRow& row) {
  std::string label = row.label;
  for (const auto& [status, count] : row.failures) {
    label += fmt::format("\n{} of {} {}", count, row.runs, Replaced(status, "_", " "));
  }
  return label;
}

void Append(Eigen::VectorXd& values, double value) {
  values.conservativeResize(values.size() + 1);
  values[values.size() - 1] = value;
}

bool HasOneBound(const RunView& run) {
  return std::isfinite(run.bound_npe) && run.rungs.values.size() < 2;
}

bool HasNumbers(const RunRow& row) { return row.npe.array().isFinite().any(); }

std::string Finding(const RunView& run) {
  std::string text = "Median NPE:";
  for (const RunRow& row : run.rows) {
    text += fmt::format(
        " {} {},", row.label,
        HasNumbers(row) ? SignificantText(100 * BoxOf(0, row.npe).median) + " %" : "none");
    if (row.failed() > 0) text += fmt::format(" with {} of {} failed,", row.failed(), row.runs);
  }
  // the bound where it is the same for all
  text.back() = '.';
  if (HasOneBound(run)) {
    text += fmt::format(" The Cramér-Rao bound is {} % rms.", SignificantText(100 * run.bound_npe));
  }
  return text;
}

}  // namespace

std::optional<Figure> NpeBoxes(const RunView& run) {
  Plot plot;
  std::vector<std::string> labels;
  std::vector<Eigen::VectorXd> shown;
  Scatter means{Eigen::VectorXd(0), Eigen::VectorXd(0), 4, Marker::diamond};
  // a box and a root mean square for each; who gave no numbers keeps the place
  for (const RunRow& row : run.rows) {
    if (HasNumbers(row)) {
      const auto place = static_cast<double>(labels.size());
      plot.series.push_back({"", IdentifierHue(row.identifier), BoxOf(place, 100 * row.npe)});
      shown.push_back(100 * row.npe);
      Append(means.x, place);
      Append(means.y, 100 * RootMeanSquare(row.npe));
    }
    labels.push_back(LabelOf(row));
  }
  if (shown.empty()) return std::nullopt;
  plot.series.push_back({"root mean square", Hue::text, means});
  // variants have a bound each: one line for all of them would say nothing
  if (HasOneBound(run)) {
    const double bound = 100 * run.bound_npe;
    plot.series.push_back({"Cramér-Rao bound (rms)", Hue::text, LevelLine{bound}});
    shown.push_back(Eigen::Vector2d(0.9 * bound, 1.1 * bound));
  }
  // identifiers side by side, on a logarithmic axis where their errors differ much
  plot.x = CategoryAxis("", labels);
  plot.y = MagnitudeAxis("NPE, continuous (%)", shown);

  return SinglePlot(
      {"npe_boxes", "Parameter error of each identifier",
       RunSubtitle(run, "boxes hold the middle half and its median, whiskers 90 %"), Finding(run)},
      plot);
}

}  // namespace warmjoint::report

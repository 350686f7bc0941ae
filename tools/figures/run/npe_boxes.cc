// Parameter error of each identifier as box plots.
#include <fmt/core.h>

#include <cmath>

#include "models/foundation/robust_noise.h"
#include "tools/board/statistics.h"
#include "tools/figures/axes.h"
#include "tools/figures/run/run_figures.h"
#include "tools/figures/symbols.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint::figures {
namespace {

/// Whiskers from the 5 % to the 95 % quantile.
Box BoxOf(double x, const Eigen::VectorXd& values) {
  const std::vector<double> sorted = SortedFinite(values);
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
  box.outliers = VectorOf(outliers);
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

bool HasNumbers(const Eigen::VectorXd& values) { return values.array().isFinite().any(); }

/// The rms NPE at the bound of a rung, or of the whole run; NaN where it is not known.
double BoundOf(const RunView& run, const Rung& rung) {
  if (!rung) return run.bound_npe;
  const auto place = static_cast<std::size_t>(*rung);
  return place < run.board.groups.size() ? run.board.groups[place].bound_npe_continuous
                                         : std::nan("");
}

std::string Finding(const RunView& run) {
  std::string text = "Median NPE:";
  for (const Rung& rung : RungsOf(run)) {
    if (rung) text += fmt::format(" with {}", RungName(run, rung));
    for (const RunRow& row : run.rows) {
      const Eigen::VectorXd npe = At(row, row.npe, rung);
      text += fmt::format(
          " {} {},", row.label,
          HasNumbers(npe) ? SignificantText(100 * BoxOf(0, npe).median) + " %" : "none");
      if (row.failed() > 0 && !rung) {
        text += fmt::format(" with {} of {} failed,", row.failed(), row.runs);
      }
    }
    text.back() = ';';
  }
  // the bound where it is the same for all
  text.back() = '.';
  if (RungsOf(run).size() == 1 && std::isfinite(run.bound_npe)) {
    text += fmt::format(" The Cramér-Rao bound is {} % rms.", SignificantText(100 * run.bound_npe));
  }
  return text;
}

/// A box and a root mean square for each identifier; who gave no numbers keeps the place. No series where nobody did.
Plot BoxesOf(const RunView& run, const Rung& rung) {
  Plot plot;
  std::vector<std::string> labels;
  std::vector<Eigen::VectorXd> shown;
  std::vector<double> places, means;
  for (const RunRow& row : run.rows) {
    const Eigen::VectorXd npe = At(row, row.npe, rung);
    if (HasNumbers(npe)) {
      const auto place = static_cast<double>(labels.size());
      plot.series.push_back({"", IdentifierHue(row.identifier), BoxOf(place, 100 * npe)});
      shown.push_back(100 * npe);
      places.push_back(place);
      means.push_back(100 * RootMeanSquareOf({npe.begin(), npe.end()}));
    }
    labels.push_back(rung ? row.label : LabelOf(row));
  }
  if (shown.empty()) return plot;
  plot.series.push_back({"root mean square", Hue::text,
                         Scatter{VectorOf(places), VectorOf(means), 4, Marker::diamond}});
  if (const double bound = 100 * BoundOf(run, rung); std::isfinite(bound)) {
    plot.series.push_back({"Cramér-Rao bound (rms)", Hue::text, LevelLine{bound}});
    shown.push_back(Eigen::Vector2d(0.9 * bound, 1.1 * bound));
  }
  // identifiers side by side, on a logarithmic axis where their errors differ much
  plot.x = CategoryAxis("", labels);
  plot.y = MagnitudeAxis("NPE, continuous (%)", shown);
  return plot;
}

}  // namespace

std::optional<Figure> NpeBoxes(const RunView& run) {
  Figure figure =
      WithoutPanels({"npe_boxes", "Parameter error of each identifier",
                     RungsSubtitle(run, "boxes hold the middle half and its median, whiskers 90 %"),
                     Finding(run)});
  // a row for each variant
  for (const Rung& rung : RungsOf(run)) {
    Plot plot = BoxesOf(run, rung);
    if (plot.series.empty()) continue;
    AddPanel(figure, RungName(run, rung), std::move(plot), rung ? 200 : 350);
  }
  if (figure.panels.empty()) return std::nullopt;
  return figure;
}

}  // namespace warmjoint::figures

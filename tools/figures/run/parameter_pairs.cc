// Errors of pairs of parameters with their ellipses.
#include <fmt/core.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "tools/board/statistics.h"
#include "tools/figures/axes.h"
#include "tools/figures/run/run_figures.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

// half axes of the ellipse that holds 95 % of a plane normal, in standard deviations: chi^2, 2
const double kReach95 = std::sqrt(-2 * std::log(0.05));

/// Relative errors of a parameter, per cent, [R].
Eigen::VectorXd Errors(const ParameterColumn& column) {
  return 100 * (column.estimate - column.truth).cwiseQuotient(column.truth.cwiseAbs());
}

/// Rows without NaN, [n x d].
Eigen::MatrixXd Complete(const RunRow& row) {
  Eigen::MatrixXd errors(row.npe.size(), row.parameters.size());
  for (std::size_t i = 0; i < row.parameters.size(); ++i) {
    errors.col(static_cast<Eigen::Index>(i)) = Errors(row.parameters[i]);
  }
  Eigen::Index n = 0;
  for (Eigen::Index i = 0; i < errors.rows(); ++i) {
    if (errors.row(i).allFinite()) errors.row(n++) = errors.row(i).eval();
  }
  return errors.topRows(n);
}

Eigen::MatrixXd CovarianceOf(const Eigen::MatrixXd& errors) {
  const Eigen::MatrixXd centred = errors.rowwise() - errors.colwise().mean();
  return centred.transpose() * centred / static_cast<double>(errors.rows() - 1);
}

/// Outline of the 95 % ellipse.
Line Ellipse(const Eigen::Vector2d& centre, const Eigen::Matrix2d& covariance, Dash dash) {
  constexpr int kPoints = 121;
  // a circle that the root of the covariance stretches
  const Eigen::Matrix2d root = covariance.llt().matrixL();
  Line line{Eigen::VectorXd(kPoints), Eigen::VectorXd(kPoints), 1.6, dash};
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * M_PI * i / (kPoints - 1);
    const Eigen::Vector2d point =
        centre + kReach95 * root * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    line.x[i] = point[0];
    line.y[i] = point[1];
  }
  return line;
}

/// The row of the lowest median error that estimates all parameters.
const RunRow* BestComplete(const RunView& run) {
  const RunRow* best = nullptr;
  double lowest = INFINITY;
  for (const RunRow& row : run.rows) {
    // correlations need several realizations with all parameters
    if (row.parameters.size() < 2 || Complete(row).rows() < 5) continue;
    const double median = MedianOfKnown(row.npe);
    if (median < lowest) {
      lowest = median;
      best = &row;
    }
  }
  return best;
}

/// The panel of parameters a and b; the first of all names its series.
Plot PairOf(const RunView& run, const RunRow& row, const Eigen::MatrixXd& errors, Eigen::Index a,
            Eigen::Index b) {
  // the first panel has the legend of all
  const auto named = [&](const char* label) { return std::string(a == 0 && b == 1 ? label : ""); };
  const Hue hue = IdentifierHue(row.identifier);
  // errors of the pair with their ellipse
  const std::vector<Eigen::Index> pair{a, b};
  const Eigen::MatrixXd both = errors(Eigen::all, pair);
  const Line spread = Ellipse(both.colwise().mean(), CovarianceOf(both), Dash::solid);
  Plot plot;
  plot.series.push_back({named("realizations"), hue, Scatter{both.col(0), both.col(1), 2.2}});
  plot.series.push_back({named("their 95 % ellipse"), hue, spread});
  std::vector<Eigen::VectorXd> x{both.col(0), spread.x}, y{both.col(1), spread.y};
  // the ellipse of the bound lies about no error at all
  if (run.bound_covariance.rows() == errors.cols()) {
    const Line bound = Ellipse({0, 0}, run.bound_covariance(pair, pair), Dash::dashed);
    plot.series.push_back({named("Cramér-Rao bound"), Hue::text, bound});
    x.push_back(bound.x);
    y.push_back(bound.y);
  }
  // axes by the symbols of both parameters
  const auto label = [&](Eigen::Index i) {
    return fmt::format("error of {} (%)",
                       SymbolOf(row.parameters[static_cast<std::size_t>(i)].name));
  };
  plot.x = LinearAxis(label(a), x);
  plot.y = LinearAxis(label(b), y);
  return plot;
}

/// Gives all panels one scale: errors of all parameters are per cent.
void ShareScale(std::vector<Panel>& panels) {
  // the farthest end of any axis
  double reach = 0;
  for (const Panel& panel : panels) {
    const Plot& plot = std::get<Plot>(panel.content);
    for (const Axis& axis : {plot.x, plot.y}) {
      reach = std::max({reach, std::abs(axis.lower), std::abs(axis.upper)});
    }
  }
  // all axes reach as far, with zero in the middle
  for (Panel& panel : panels) {
    auto& [x, y, series] = std::get<Plot>(panel.content);
    x.lower = y.lower = -reach;
    x.upper = y.upper = reach;
  }
}

std::string Finding(const RunRow& row, const Eigen::MatrixXd& errors) {
  const Eigen::MatrixXd covariance = CovarianceOf(errors);
  Eigen::Index a = 0, b = 1;
  double strongest = 0;
  // the pair whose errors are correlated most
  for (Eigen::Index i = 0; i < errors.cols(); ++i) {
    for (Eigen::Index j = i + 1; j < errors.cols(); ++j) {
      const double r = covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
      if (std::abs(r) <= std::abs(strongest)) continue;
      strongest = r;
      a = i;
      b = j;
    }
  }
  return fmt::format("Errors of {} and {} go together most: correlation {}.",
                     row.parameters[static_cast<std::size_t>(a)].name,
                     row.parameters[static_cast<std::size_t>(b)].name,
                     SignificantText(strongest, 2));
}

}  // namespace

std::optional<Figure> ParameterPairs(const RunView& run) {
  const RunRow* row = BestComplete(run);
  if (!row) return std::nullopt;
  const Eigen::MatrixXd errors = Complete(*row);

  // every realization is a dot in each panel
  Figure figure = WithoutPanels(
      {"parameter_pairs", fmt::format("Errors of pairs of parameters: {}", row->label),
       RunSubtitle(run, "each dot is one of them"), Finding(*row, errors)},
      errors.cols() > 2 ? 3 : 1);
  // a panel for each pair of parameters
  for (Eigen::Index a = 0; a < errors.cols(); ++a) {
    for (Eigen::Index b = a + 1; b < errors.cols(); ++b) {
      AddPanel(figure, "", PairOf(run, *row, errors, a, b), 1);
    }
  }
  // one scale for all, so that their ellipses compare
  ShareScale(figure.panels);
  figure.height = 80 + 320 * static_cast<int>(figure.rows.size());
  return figure;
}

}  // namespace warmjoint::figures

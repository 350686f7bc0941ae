// Axes that fit their data, and figures put together of plots.
#pragma once

#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "tools/figures/figure.h"

namespace warmjoint::figures {

/// Numbers that were gathered one by one, as shapes have them.
template <typename Number>
Eigen::VectorX<Number> VectorOf(const std::vector<Number>& numbers) {
  return Eigen::Map<const Eigen::VectorX<Number>>(numbers.data(), std::ssize(numbers));
}

/// Lowest and highest finite value of all; (NaN, NaN) where there is none.
std::pair<double, double> RangeOf(const std::vector<Eigen::VectorXd>& values);

/// A linear axis over the values with 4 % to spare at both ends. Data without extent, or none, get
/// one about them.
Axis LinearAxis(std::string label, const std::vector<Eigen::VectorXd>& values);

/// A linear axis that starts at zero, for sizes that are compared by their height.
Axis ZeroAxis(std::string label, const std::vector<Eigen::VectorXd>& values);

/// A logarithmic axis over the positive values, with some to spare.
Axis LogarithmicAxis(std::string label, const std::vector<Eigen::VectorXd>& values);

/// A linear axis over all but the outermost share of the values at either end, with 15 % to spare:
/// single wild ones leave the picture. The whole range where that holds everything.
Axis BulkAxis(std::string label, const std::vector<Eigen::VectorXd>& values,
              double outermost = 0.001);

/// How many finite values an axis leaves out: what a subtitle owes its reader.
Eigen::Index CountBeyond(const Axis& axis, const std::vector<Eigen::VectorXd>& values);

/// Iterations `first` to `last`: whole numbers, logarithmic beyond 100 (from 1 on), with room for
/// the marks at both ends where linear.
Axis IterationAxis(double first, double last);

/// Logarithmic where the values span more than a factor of 30 and none is below 0, else from zero.
Axis MagnitudeAxis(std::string label, const std::vector<Eigen::VectorXd>& values);

/// One turn, 0 ... 2 pi rad, with ticks at its quarters.
Axis AngleAxis(std::string label);

/// An axis that names categories at 0, 1, 2, ...
Axis CategoryAxis(std::string label, const std::vector<std::string>& names);

/// Medians of y in bins of equal width over x; NaN where a bin has fewer than 8 samples.
/// x, y: [N]; returns a line of `bins` points in the middles.
Line BinnedMedian(const Eigen::VectorXd& x, const Eigen::VectorXd& y, int bins);

// Figures put together, of one that has its name and words alone.

/// A figure of that one plot.
Figure SinglePlot(Figure figure, const Plot& plot);

/// A figure of plots beside each other, each with its title. height: points. Plots without series are left out.
Figure RowOfPlots(Figure figure, double height,
                  const std::vector<std::pair<std::string, Plot>>& plots);

/// A figure for AddPanel, without panels yet: `across` of them to a row, as high as its rows ask for.
Figure WithoutPanels(Figure figure, std::size_t across = 1);

/// Adds a panel behind the last one. height: of its row, points.
void AddPanel(Figure& figure, const std::string& title, Content content, double height);

}  // namespace warmjoint::figures

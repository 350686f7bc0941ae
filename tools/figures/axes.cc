#include "tools/figures/axes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "models/foundation/robust_noise.h"

namespace warmjoint::figures {
namespace {

constexpr double kSpare = 0.04;
constexpr double kBulkSpare = 0.15;  // of the range that BulkAxis keeps

Axis Padded(std::string label, double lower, double upper) {
  if (!std::isfinite(lower)) lower = 0, upper = 1;
  if (lower == upper) {
    const double about = lower == 0 ? 1 : 0.1 * std::abs(lower);
    lower -= about;
    upper += about;
  }
  const double spare = kSpare * (upper - lower);
  return {std::move(label), lower - spare, upper + spare};
}

}  // namespace

std::pair<double, double> RangeOf(const std::vector<Eigen::VectorXd>& values) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::pair<double, double> range{kNone, kNone};
  // what is not finite has no place on an axis
  for (const Eigen::VectorXd& part : values) {
    for (double value : part) {
      if (!std::isfinite(value)) continue;
      if (!(value >= range.first)) range.first = value;
      if (!(value <= range.second)) range.second = value;
    }
  }
  return range;
}

Axis LinearAxis(std::string label, const std::vector<Eigen::VectorXd>& values) {
  const auto [lower, upper] = RangeOf(values);
  return Padded(std::move(label), lower, upper);
}

Axis ZeroAxis(std::string label, const std::vector<Eigen::VectorXd>& values) {
  const double upper = RangeOf(values).second;
  const double top = std::isfinite(upper) && upper > 0 ? upper : 1;
  return {std::move(label), 0, (1 + 2 * kSpare) * top};
}

Axis LogarithmicAxis(std::string label, const std::vector<Eigen::VectorXd>& values) {
  // values at or below zero have no logarithm and are left out
  std::vector<Eigen::VectorXd> logarithms;
  for (const Eigen::VectorXd& part : values) {
    logarithms.push_back(
        part.unaryExpr([](double v) { return v > 0 ? std::log10(v) : std::nan(""); }));
  }
  // room beyond the values is even in decades
  const auto [lower, upper] = RangeOf(logarithms);
  Axis axis = Padded(std::move(label), lower, upper);
  axis.lower = std::pow(10, axis.lower);
  axis.upper = std::pow(10, axis.upper);
  axis.scale = Scale::logarithmic;
  return axis;
}

Axis BulkAxis(std::string label, const std::vector<Eigen::VectorXd>& values, double outermost) {
  // all finite values in their order
  std::vector<double> sorted;
  for (const Eigen::VectorXd& part : values) {
    std::copy_if(part.begin(), part.end(), std::back_inserter(sorted),
                 [](double value) { return std::isfinite(value); });
  }
  if (sorted.empty()) return LinearAxis(std::move(label), values);
  std::sort(sorted.begin(), sorted.end());
  // the axis follows the bulk of the values; a few outliers may leave it
  const double lower = Quantile(sorted, outermost), upper = Quantile(sorted, 1 - outermost);
  const double spare = kBulkSpare * (upper - lower);
  return LinearAxis(std::move(label), {Eigen::Vector2d(std::max(sorted.front(), lower - spare),
                                                       std::min(sorted.back(), upper + spare))});
}

Eigen::Index CountBeyond(const Axis& axis, const std::vector<Eigen::VectorXd>& values) {
  Eigen::Index beyond = 0;
  for (const Eigen::VectorXd& part : values) {
    beyond += (part.array() < axis.lower || part.array() > axis.upper).count();
  }
  return beyond;
}

Axis IterationAxis(double first, double last) {
  constexpr double kMostLinear = 100;
  if (last > kMostLinear) {
    return {"iteration", std::max(1.0, first), last, Scale::logarithmic, {}, 1};
  }
  const double spare = 0.02 * std::max(1.0, last - first);
  return {"iteration", first - spare, std::max(last, first + 1) + spare, Scale::linear, {}, 1};
}

Axis MagnitudeAxis(std::string label, const std::vector<Eigen::VectorXd>& values) {
  const auto [lower, upper] = RangeOf(values);
  const bool wide = lower > 0 && upper > 30 * lower;
  return wide ? LogarithmicAxis(std::move(label), values) : ZeroAxis(std::move(label), values);
}

Axis AngleAxis(std::string label) {
  static constexpr const char* kNames[] = {"0", "π/2", "π", "3π/2", "2π"};
  Axis axis{std::move(label), 0, 2 * std::numbers::pi};
  for (int i = 0; i < 5; ++i) axis.ticks.push_back({i * std::numbers::pi / 2, kNames[i]});
  return axis;
}

Axis CategoryAxis(std::string label, const std::vector<std::string>& names) {
  Axis axis{std::move(label), -0.5, static_cast<double>(names.size()) - 0.5};
  for (const std::string& name : names) {
    axis.ticks.push_back({static_cast<double>(axis.ticks.size()), name});
  }
  return axis;
}

Line BinnedMedian(const Eigen::VectorXd& x, const Eigen::VectorXd& y, int bins) {
  constexpr std::size_t kFewest = 8;
  const auto [lower, upper] = RangeOf({x});
  std::vector<std::vector<double>> values(static_cast<std::size_t>(bins));
  // the samples of each bin
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double share = upper > lower ? (x[i] - lower) / (upper - lower) : 0;
    const int bin = std::min(bins - 1, static_cast<int>(share * bins));
    values[static_cast<std::size_t>(bin)].push_back(y[i]);
  }
  // a bin with few samples is a gap in the line
  Line line{Eigen::VectorXd(bins), Eigen::VectorXd(bins), 2.0};
  for (int bin = 0; bin < bins; ++bin) {
    std::vector<double>& own = values[static_cast<std::size_t>(bin)];
    line.x[bin] = lower + (upper - lower) * (bin + 0.5) / bins;
    std::sort(own.begin(), own.end());
    line.y[bin] = own.size() < kFewest ? std::nan("") : Quantile(own, 0.5);
  }
  return line;
}

Figure SinglePlot(Figure figure, const Plot& plot) {
  return RowOfPlots(std::move(figure), 440, {{"", plot}});
}

Figure RowOfPlots(Figure figure, double height,
                  const std::vector<std::pair<std::string, Plot>>& plots) {
  figure.height = height;
  figure.columns.clear();
  for (const auto& [title, plot] : plots) {
    if (plot.series.empty()) continue;
    figure.panels.push_back({title, plot, 0, static_cast<int>(figure.panels.size())});
    figure.columns.push_back(1);
  }
  return figure;
}

Figure WithoutPanels(Figure figure, std::size_t across) {
  figure.height = 0;
  figure.rows.clear();
  figure.columns.assign(across, 1);
  return figure;
}

void AddPanel(Figure& figure, const std::string& title, Content content, double height) {
  const std::size_t place = figure.panels.size(), across = figure.columns.size();
  if (place % across == 0) figure.rows.push_back(height);
  figure.panels.push_back({title, std::move(content), static_cast<int>(place / across),
                           static_cast<int>(place % across)});
}

}  // namespace warmjoint::figures

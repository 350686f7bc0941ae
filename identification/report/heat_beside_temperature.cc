#include "identification/report/heat_beside_temperature.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "identification/linear/least_squares.h"
#include "identification/report/by_parameters.h"
#include "identification/uncertainty/tails.h"
#include "identification/uncertainty/uncertainty.h"
#include "models/friction/joint_kind.h"
#include "models/recording/course_of.h"
#include "models/recording/sampling.h"

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;

constexpr Index kRows = 2000;  // at most, of means
constexpr Index kFewestRows = 20;
constexpr int kLags = 24;             // that are tried
constexpr double kByChance = 1e-3;    // probability below which a lag is beyond doubt
constexpr double kWorthwhile = 0.05;  // of the squares that are left, at least, for a lag

/// Means over neighbouring samples of one recording.
struct Means {
  Eigen::VectorXd temperature;                 // [n] degC
  Eigen::MatrixXd levels;                      // [n x R] 1 for the recording that the row is of
  std::vector<std::pair<Index, Index>> spans;  // [n] samples

  Eigen::VectorXd Of(const Eigen::VectorXd& all) const {
    Eigen::VectorXd means(static_cast<Index>(spans.size()));
    for (size_t i = 0; i < spans.size(); ++i) {
      const auto& [begin, end] = spans[i];
      means[static_cast<Index>(i)] = all.segment(begin, end - begin).mean();
    }
    return means;
  }
};

Means MeansOf(const Measurements& m) {
  // where recordings begin and end, and how many samples make one mean
  std::vector<Index> bounds(m.starts.begin(), m.starts.end());
  bounds.insert(bounds.begin(), 0);
  bounds.push_back(m.size());
  const Index together = (m.size() + kRows - 1) / kRows;

  // no mean reaches from one recording into the next
  Means means;
  std::vector<Index> recording;
  for (size_t r = 0; r + 1 < bounds.size(); ++r) {
    for (Index at = bounds[r]; at < bounds[r + 1]; at += together) {
      means.spans.emplace_back(at, std::min(at + together, bounds[r + 1]));
      recording.push_back(static_cast<Index>(r));
    }
  }

  // a constant for each recording
  const auto n = static_cast<Index>(means.spans.size());
  means.levels = Eigen::MatrixXd::Zero(n, static_cast<Index>(bounds.size()) - 1);
  for (Index i = 0; i < n; ++i) means.levels(i, recording[static_cast<size_t>(i)]) = 1;
  means.temperature = means.Of(*m.temperature);
  return means;
}

/// T = b E + T0 by least squares.
struct LineFit {
  double lag = 0;           // s
  Eigen::MatrixXd columns;  // [n x (1 + R)] E, then a 1 for each recording
  LeastSquares solved;
  Eigen::VectorXd residual;  // [n] K
  double squares() const { return residual.squaredNorm(); }
};

/// What differs from the mean of its recording.
Eigen::VectorXd Centred(const Eigen::VectorXd& values, const Means& means) {
  return values - means.levels * SolveLeastSquares(means.levels, values).solution;
}

/// Nothing where E does not vary.
std::optional<LineFit> FitLine(const Means& means, const Eigen::VectorXd& energy, double lag,
                               const Measurements& m) {
  LineFit line;
  line.lag = lag;
  // E behind the lag, beside a constant for each recording
  line.columns.resize(means.temperature.size(), 1 + means.levels.cols());
  line.columns << Centred(means.Of(Lagged(energy, lag, m.time, m.starts)), means), means.levels;
  line.solved = SolveLeastSquares(line.columns, means.temperature);
  // an E that does not vary tells no slope
  if (!line.solved.mixed.empty()) return std::nullopt;
  line.residual = means.temperature - line.columns * line.solved.solution;
  return line;
}

/// The line and how sure its slope is.
struct KnownLine {
  LineFit fit;
  double deviation = 0;    // of the slope
  double independent = 0;  // rows that would tell as much, were what is left white
};

KnownLine Judge(LineFit fit) {
  const Index n = fit.residual.size(), p = fit.columns.cols();

  // the covariance allows for the colour of the residual
  Selection all;
  all.keep.setConstant(n, true);
  const Uncertainty known = JudgeUncertainty(fit.columns, fit.solved.cofactor, fit.residual, all);
  const double white = fit.squares() / static_cast<double>(n - p) * fit.solved.cofactor(0, 0);
  KnownLine line{std::move(fit), known.Deviation(0), static_cast<double>(n)};
  // coloured noise makes fewer rows count
  const double variance = known.covariance(0, 0);
  if (variance > white) line.independent *= white / variance;
  return line;
}

/// The line with the lag that leaves least, where it does so beyond doubt; nothing where E does not
/// vary.
std::optional<KnownLine> BestLine(const Means& means, const Eigen::VectorXd& energy,
                                  const Measurements& m) {
  const std::optional<LineFit> without = FitLine(means, energy, 0, m);
  if (!without) return std::nullopt;
  KnownLine plain = Judge(*without);

  // lags from two rows to half the log, the same ratio apart
  const double duration = m.time[m.size() - 1] - m.time[0];
  const double shortest = 2 * duration / static_cast<double>(means.spans.size());
  const double ratio = std::pow(0.5 * duration / shortest, 1.0 / (kLags - 1));
  LineFit best = plain.fit;
  for (int i = 0; i < kLags; ++i) {
    std::optional<LineFit> one = FitLine(means, energy, shortest * std::pow(ratio, i), m);
    if (one && one->squares() < best.squares()) best = std::move(*one);
  }

  // the best must leave clearly less, and not by chance: an F test, by Bonferroni over all tried
  const double gained = plain.fit.squares() - best.squares();
  if (!(gained > kWorthwhile * plain.fit.squares())) return plain;
  KnownLine lagged = Judge(best);
  const double freedom = lagged.independent - static_cast<double>(best.columns.cols()) - 1;
  if (freedom < 1) return plain;
  const double f = gained / (best.squares() / freedom);
  return PValueOfF(f, 1, freedom) * kLags < kByChance ? lagged : plain;
}

/// A row with an interval of Student's t, where anything is left to tell one by.
EstimatedParameter Row(std::string name, double value, std::string unit, double deviation,
                       double freedom) {
  EstimatedParameter row{std::move(name), value, std::move(unit), {}, {}};
  if (!(freedom >= 1) || !std::isfinite(deviation)) return row;
  row.std = deviation;
  const double half = StudentQuantile(freedom, kIntervalLevel) * deviation;
  row.interval95 = {{value - half, value + half}};
  return row;
}

/// The correlation with an interval by Fisher's z.
EstimatedParameter Correlation(const Means& means, const KnownLine& line) {
  // the share of the squares that the line explains, with the sign of its slope
  const double all = Centred(means.temperature, means).squaredNorm();
  const double share = std::clamp(1 - line.fit.squares() / all, 0.0, 1.0);
  const double r = std::copysign(std::sqrt(share), line.fit.solved.solution[0]);
  EstimatedParameter row{"correlation", r, "1", {}, {}};

  // atanh r is about normal; the line and each recording's constant take rows from it
  const double left = line.independent - 2 - static_cast<double>(means.levels.cols());
  if (left < 1 || std::abs(r) >= 1) return row;
  const double half = StudentQuantile(kInfinity, kIntervalLevel) / std::sqrt(left);
  row.interval95 = {{std::tanh(std::atanh(r) - half), std::tanh(std::atanh(r) + half)}};
  return row;
}

/// Whether E is the gain times what the losses leave, so that a slope per W can be told.
bool TellsPerLoss(const FrictionDescription& friction, const Measurements& m) {
  return !friction.second_thermal && m.torque_unit == kTorqueUnit.For(m.joint);
}

bool Varies(const Eigen::VectorXd& values) {
  return values.allFinite() && values.maxCoeff() > values.minCoeff();
}

}  // namespace

Eigen::VectorXd Lagged(const Eigen::VectorXd& course, double lag, const Eigen::VectorXd& time,
                       const std::vector<Index>& starts) {
  if (lag == 0) return course;
  Eigen::VectorXd lagged = course;
  for (Index i = 1; i < course.size(); ++i) {
    // another recording begins settled on its first sample
    if (std::ranges::binary_search(starts, i)) continue;
    // towards the sample before, held until this one
    const double kept = std::exp(-(time[i] - time[i - 1]) / lag);
    lagged[i] = kept * lagged[i - 1] + (1 - kept) * course[i - 1];
  }
  return lagged;
}

std::vector<EstimatedParameter> HeatBesideTemperature(const Fit& fit, const Inference& inference,
                                                      const FrictionDescription& friction,
                                                      const Measurements& m) {
  if (!m.temperature || !friction.thermal || !Varies(*m.temperature)) return {};
  // E along the log, and the line of the temperature over it
  const Eigen::VectorXd energy = PredictFriction(friction, m, fit.Start()).energy;
  const Means means = MeansOf(m);
  if (means.temperature.size() < kFewestRows || !Varies(energy)) return {};
  const std::optional<KnownLine> line = BestLine(means, energy, m);
  if (!line) return {};

  // the slope over E, and times its gain over the loss, with what is not known of E itself
  const auto slopes = [&](const FrictionDescription& one, const CourseStart& start) {
    const auto other = FitLine(means, PredictFriction(one, m, start).energy, line->fit.lag, m);
    const double slope = other ? other->solved.solution[0] : 0;
    return Eigen::VectorXd(Eigen::Vector2d(slope, slope * one.thermal->gain));
  };
  const Eigen::VectorXd values = slopes(friction, fit.Start());
  const FigureErrors errors =
      ErrorsBySlopes(fit, inference, SlopesByDifferences(fit, inference, friction, slopes));
  // without intervals of the friction's parameters there are none here
  const double freedom =
      errors.told ? line->independent - static_cast<double>(line->fit.columns.cols()) : 0;
  const auto row = [&](std::string name, int i, double factor, std::string unit) {
    const double deviation =
        std::hypot(factor * line->deviation, std::sqrt(errors.covariance(i, i)));
    return Row(std::move(name), values[i], std::move(unit), deviation, freedom);
  };

  // how well both go together, by how much, and what the line leaves
  std::vector<EstimatedParameter> rows{
      Correlation(means, *line), row("per_energy", 0, 1, fmt::format("K/({})", m.torque_unit))};
  if (TellsPerLoss(friction, m)) rows.push_back(row("per_loss", 1, friction.thermal->gain, "K/W"));
  const auto n = static_cast<double>(line->fit.residual.size());
  rows.push_back({"lag", line->fit.lag, "s", {}, {}});
  rows.push_back({"rmse", std::sqrt(line->fit.squares() / n), "K", {}, {}});
  return rows;
}

}  // namespace warmjoint::inline identification

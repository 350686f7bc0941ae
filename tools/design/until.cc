#include "tools/design/until.h"

#include <warmjoint/identify.h>

#include <algorithm>
#include <cmath>

#include "identification/linear/linear_laws.h"
#include "tools/design/possible_joint.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr double kFarthest =
    20;  // why: lengths of the log so far, beyond which nobody trusts a forecast
constexpr double kFirst = 60;  // s, why: shorter logs are refused for their few holds
constexpr double kLeastStep =
    0.01;  // why: of the time, so that a stop is late by a fifth of the forecast's own error
constexpr double kLongestStep = 0.1;  // why: of the time, since a wide interval foretells little

/// Minutes of the log's kind of motion until the half width is `share`; nothing where it takes too long. half: at its end
std::optional<double> Forecast(const Estimate& estimate, const LogView& log, const DesignAim& aim,
                               double rate, double half) {
  if (!estimate.friction || !IsLinear(*FindLaw(estimate.friction->law))) return std::nullopt;
  const PossibleJoint joint(*estimate.friction, StartBelief::cold, 1, rate);
  const double seconds =
      log.measurements.time[log.measurements.size() - 1] - log.measurements.time[0];
  double length = seconds / 300;
  if (estimate.friction->thermal) {
    length = std::min(length, estimate.friction->thermal->time_constant / 10);
  }
  const MotionCells seen = CellsOf(log, std::max(length, seconds / 3000));
  const AimCost cost(aim, joint, seen);
  // by the information, as much as the half width has to shrink
  const double wanted = cost(joint.Information(seen)) + std::log(*aim.share / half);
  const auto reached = [&](double longer) {
    return cost(joint.Information(Repeated(seen, longer * seconds))) <= wanted;
  };
  if (!reached(kFarthest)) return std::nullopt;
  double below = 1, beyond = kFarthest;
  while (beyond - below > 0.005 * below) {
    const double middle = std::sqrt(below * beyond);
    (reached(middle) ? beyond : below) = middle;
  }
  return (beyond - 1) * seconds / 60;
}

}  // namespace

MotionCells CellsOf(const LogView& log, double length) {
  const LogSamples& m = log.measurements;
  const double begin = m.time[0], seconds = m.time[m.size() - 1] - begin;
  const auto n = std::max<Index>(static_cast<Index>(std::ceil(seconds / length)), 2);
  MotionCells cells;
  cells.length = length;
  cells.time = length * Eigen::VectorXd::LinSpaced(n, 0, static_cast<double>(n - 1));
  cells.velocity = cells.mean_speed = cells.loss_velocity = cells.held = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd square = Eigen::VectorXd::Zero(n);
  for (Index i = 0; i + 1 < m.size(); ++i) {
    const Index cell = std::min(static_cast<Index>((m.time[i] - begin) / length), n - 1);
    const double step = m.time[i + 1] - m.time[i], v = m.velocity[i];
    cells.mean_speed[cell] += step * std::abs(v);
    square[cell] += step * v * v;
    if (!log.selection.keep[i] || v == 0) continue;
    cells.held[cell] += step;
    cells.velocity[cell] = v;
  }
  for (Index i = 0; i < n; ++i) {
    if (cells.mean_speed[i] == 0) continue;
    cells.loss_velocity[i] = std::copysign(square[i] / cells.mean_speed[i], cells.velocity[i]);
    cells.mean_speed[i] /= length;
  }
  return cells;
}

MotionCells Repeated(const MotionCells& cells, double seconds) {
  const Index seen = cells.time.size();
  const auto n = std::max<Index>(static_cast<Index>(std::llround(seconds / cells.length)), 2);
  MotionCells longer{cells.length};
  longer.time = cells.length * Eigen::VectorXd::LinSpaced(n, 0, static_cast<double>(n - 1));
  for (const auto column : {&MotionCells::velocity, &MotionCells::mean_speed,
                            &MotionCells::loss_velocity, &MotionCells::held}) {
    longer.*column =
        Eigen::VectorXd::NullaryExpr(n, [&](Index i) { return (cells.*column)[i % seen]; });
  }
  return longer;
}

Sufficiency LookWhether(const PreparedLog& log, const DesignAim& aim,
                        const IdentifySettings& settings) {
  const LogView& view = log.constant_speed();
  const Eigen::VectorXd& time = view.measurements.time;
  Sufficiency found;
  found.minutes = (time[time.size() - 1] - time[0]) / 60;
  const Estimate estimate = Identify(log, settings, {.fraction = 0});
  found.status = estimate.status;
  found.message = estimate.message;
  found.half_width = HalfWidthShare(estimate, aim);
  if (!found.half_width) return found;
  found.reached = *found.half_width <= *aim.share;
  if (found.reached) return found;
  const double rate = static_cast<double>(time.size() - 1) / (60 * found.minutes);
  found.minutes_more = Forecast(estimate, view, aim, rate, *found.half_width);
  return found;
}

Sufficiency LookUntil(const PreparedLog& log, const DesignAim& aim,
                      const IdentifySettings& settings,
                      const std::function<void(const Sufficiency&)>& watch) {
  const Eigen::VectorXd& time = log.raw().measurements.time;
  const double begin = time[0], seconds = time[time.size() - 1] - begin;
  double at = std::min(kFirst, seconds);
  while (true) {
    const bool whole = at >= seconds;
    const Sufficiency found = LookWhether(whole ? log : log.Before(begin + at), aim, settings);
    if (watch) watch(found);
    if (found.reached || whole) return found;
    // half of the way to where it is foretold, and no smaller step than is worth it
    const double step = found.minutes_more ? 30 * *found.minutes_more : kLeastStep * at;
    at = std::min(at + std::clamp(step, kLeastStep * at, kLongestStep * at), seconds);
  }
}

}  // namespace warmjoint

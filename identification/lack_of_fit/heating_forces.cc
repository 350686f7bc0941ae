#include "identification/lack_of_fit/heating_forces.h"

#include <algorithm>
#include <cmath>

#include "identification/lack_of_fit/with_heat.h"
#include "models/foundation/four.h"
#include "models/friction/sign.h"

namespace warmjoint {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

// why: a drift that takes half the log to die away is still nearly even, one of an eighth is over before the
// warming is; between them by halves
constexpr double kSlowest = 1.0 / 2;  // of the log: the longest time constant of a drift

/// exp(-rate t). t: [N] share of the log, from 0 to 1
ArrayXd Decay(const FittedModel& model, const ArrayXd& t, double rate) {
  const bool even = model.loop && model.loop->intervals().even();
  if (!even) return (-rate * t).exp();

  // of an even clock by products: what is known of it, later by as many steps, twice as much each time
  const Index n = t.size();
  const double step = rate / static_cast<double>(n - 1);
  ArrayXd decay = ArrayXd::Ones(n);
  for (Index known = 1; known < n; known *= 2) {
    const Index more = std::min(known, n - known);
    decay.segment(known, more) = std::exp(-step * static_cast<double>(known)) * decay.head(more);
  }
  return decay;
}

/// t: [N] share of the log; slowest: [N] what the slowest drift has left to do by then. [m x 8], drifts, level, bend, slope
/// and zeros
WARMJOINT_FOR_EACH_PROCESSOR
MatrixXd Along(const FittedModel& model, const Measurements& m, const Bins& bins, const ArrayXd& t,
               const ArrayXd& slowest) {
  // the law's forces at a velocity beside that of the sample, whose direction they have
  const auto by_speed = [&](Index n, double v, Four& g) {
    const double along = Sign(m.velocity[n]) * v;
    g = Four{1, along * std::abs(v), along * model.energy[n], 0};
  };
  // drifts that die away, each the square of the one before it, so that they end at 1
  const double end = slowest[m.size() - 1], second_end = end * end;
  const Four scale{1, 1 / (1 - end), 1 / (1 - second_end), 1 / (1 - second_end * second_end)};
  const auto levels = [&](Index n, Fours<2>& g) {
    const double first = slowest[n], second = first * first, third = second * second;
    g[0] = scale * Four{t[n], 1 - first, 1 - second, 1 - third};
    by_speed(n, m.velocity[n], g[1]);
  };

  // where the log tells the speed of the losses, theirs
  if (!m.loss_velocity) {
    return WithHeat<2>(model, m.velocity, bins, levels, [](Index, Fours<2>&) {});
  }
  return WithHeat<2>(model, m.velocity, bins, levels,
                     [&](Index n, Fours<2>& g) { by_speed(n, (*m.loss_velocity)[n], g[1]); });
}

}  // namespace

HeatingForces HeatingForcesOf(const FittedModel& model, const Measurements& m, const Bins& bins) {
  const double share = 1 / (m.time[m.size() - 1] - m.time[0]);
  const ArrayXd t = (m.time.array() - m.time[0]) * share;
  const MatrixXd all = Along(model, m, bins, t, Decay(model, t, 1 / kSlowest));
  return {all.leftCols(kCourses), all.col(kCourses), all.col(kCourses + 1),
          all.middleCols(kCourses + 2, model.thermal ? 1 : 0)};
}

}  // namespace warmjoint

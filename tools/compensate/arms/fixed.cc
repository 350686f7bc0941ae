// Compensators that do not change: `none`, `fixed` (a friction file's cold law, the line through the day before, or a table by
// temperature of that day) and `truth`.
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "identification/forward/log_trajectory.h"
#include "models/foundation/bad_input.h"
#include "models/friction/sign.h"
#include "scenarios/suite.h"
#include "tools/compensate/arms/arm_list.h"

namespace warmjoint {
namespace {

/// What a fixed friction is of.
enum class Knows { cold, before, temperature };
inline std::span<const Word<Knows>> WordsOf(Knows) {
  static constexpr std::array words{Word{"cold", Knows::cold}, Word{"before", Knows::before},
                                    Word{"temperature", Knows::temperature}};
  return words;
}

struct FixedOptions {
  Knows knows = Knows::cold;
  double begin = 0;
  double end = 86400;

  template <class A>
  void Serialize(A* a) {
    a->Field(
        "knows", &knows,
        {.meaning = "the cold law of the friction file, a line through the day before, or a table "
                    "of that day by the temperature that a sensor reads"});
    a->Field("begin", &begin,
             {.unit = "s", .bounds = {.at_least = 0}, .meaning = "of what counts of that day"});
    a->Field("end", &end, {.unit = "s", .bounds = {.above = 0}, .meaning = "of the same"});
  }
};

// --- a table by temperature: F = k v + level(T) sign(v)

/// why: drives tell their temperature in whole kelvins.
constexpr double kTableStep = 1;  // K

const Eigen::VectorXd& TemperatureOf(const LogSamples& log) {
  if (!log.temperature) Refuse({"compensator"}, "fixed by temperature needs a column temperature");
  return *log.temperature;
}

/// Sums over the samples of a step of the table.
struct StepSums {
  double count = 0, temperature = 0, speed = 0, torque = 0;
  double speed_squared = 0, speed_torque = 0;

  void Add(double t, double v, double y) {
    count += 1, temperature += t, speed += v, torque += y;
    speed_squared += v * v, speed_torque += v * y;
  }
};

/// Straight lines between the mean temperatures of the steps, and its ends beyond them.
struct TemperatureTable {
  double viscous = 0;               // N.m.s/rad or N.s/m
  std::vector<double> temperature;  // degC, ascending
  std::vector<double> level;        // N.m or N

  double LevelAt(double t) const {
    const auto above = std::ranges::upper_bound(temperature, t);
    if (above == temperature.begin()) return level.front();
    if (above == temperature.end()) return level.back();
    const auto i = static_cast<std::size_t>(above - temperature.begin());
    const double share = (t - temperature[i - 1]) / (temperature[i] - temperature[i - 1]);
    return std::lerp(level[i - 1], level[i], share);
  }
};

/// Of the samples from `begin` to before `end` (s) that move.
TemperatureTable TableOf(const LogSamples& log, double begin, double end) {
  const Eigen::VectorXd& temperature = TemperatureOf(log);
  std::map<double, StepSums> steps;
  for (Eigen::Index i = 0; i < log.size(); ++i) {
    const double v = log.velocity[i], t = temperature[i];
    if (v == 0 || log.time[i] < begin || log.time[i] >= end) continue;
    steps[std::floor(t / kTableStep)].Add(t, std::abs(v), log.torque[i] * Sign(v));
  }

  // the slope about the means of each step, in which the level is steady; then the levels
  double spread = 0, shared = 0;
  for (const auto& [place, sums] : steps) {
    spread += sums.speed_squared - sums.speed * sums.speed / sums.count;
    shared += sums.speed_torque - sums.speed * sums.torque / sums.count;
  }
  if (spread <= 0) Refuse({"compensator"}, "has no two speeds of the day before");
  TemperatureTable table{shared / spread, {}, {}};
  for (const auto& [place, sums] : steps) {
    table.temperature.push_back(sums.temperature / sums.count);
    table.level.push_back((sums.torque - table.viscous * sums.speed) / sums.count);
  }
  return table;
}

Eigen::VectorXd AlongTable(const CompensatorInput& input, const TemperatureTable& table) {
  const Eigen::VectorXd& temperature = TemperatureOf(input.log);
  Eigen::VectorXd found(input.log.size());
  for (Eigen::Index i = 0; i < found.size(); ++i) {
    const SpeedLine line{table.viscous, table.LevelAt(temperature[i])};
    found[i] = line.At(input.log.velocity[i]);
  }
  return found;
}

Eigen::VectorXd AlongFixed(const CompensatorInput& input) {
  const auto& options = input.options.Get<FixedOptions>();
  if (options.knows == Knows::before) {
    const SpeedLine line = LineOf(input.before, options.begin, options.end);
    return input.log.velocity.unaryExpr([&](double v) { return line.At(v); });
  }
  if (options.knows == Knows::temperature) {
    return AlongTable(input, TableOf(input.before, options.begin, options.end));
  }
  Friction cold = input.known;
  cold.thermal.reset();
  return PredictFriction(cold, input.log).force;
}

}  // namespace

CompensatorArm NoCompensation() {
  return {"none", "no torque", {}, [](const CompensatorInput& input) -> Eigen::VectorXd {
            return Eigen::VectorXd::Zero(input.log.size());
          }};
}

CompensatorArm FixedFriction() {
  return {"fixed", "viscous and Coulomb friction that never change", FixedOptions{}, AlongFixed};
}

CompensatorArm TrueFriction() {
  return {kTruthCompensator,
          "the true friction",
          {},
          [](const CompensatorInput& input) { return *input.truth; },
          Sees::truth};
}

}  // namespace warmjoint

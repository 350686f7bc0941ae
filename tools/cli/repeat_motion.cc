#include "tools/cli/repeat_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "identification/estimate.h"
#include "identification/preparation/select.h"
#include "scenarios/yaml_motion.h"
#include "sim/plant/motion_of.h"

namespace warmjoint::inline tools {
namespace {

/// Torque at a time within the recording, N.m or N.
double TorqueAt(const Measurements& m, double time) {
  // between the samples on both sides of it
  const double* begin = m.time.data();
  const auto after = std::upper_bound(begin, begin + m.size(), time) - begin;
  const auto i = std::clamp<Eigen::Index>(after, 1, m.size() - 1);
  const double share = (time - m.time[i - 1]) / (m.time[i] - m.time[i - 1]);
  return m.torque[i - 1] + share * (m.torque[i] - m.torque[i - 1]);
}

}  // namespace

Settings MotionSettings(const Measurements& log) {
  // the scenario moves as the log does, for as long
  const Motion motion = MotionOf(log, SelectConstantSpeed(log));
  return {{"motion", MotionToYaml(motion, "")},
          {"duration", fmt::format("{}", log.time[log.size() - 1] - log.time[0])}};
}

std::string CompareTorque(const Measurements& log, const Measurements& simulated) {
  // amperes and torques do not compare
  if (log.torque_unit != simulated.torque_unit) {
    return fmt::format("torque not compared: recorded in {}, simulated in {}\n", log.torque_unit,
                       simulated.torque_unit);
  }

  // samples at constant speed, at the times since the beginning of each
  const Selection selection = SelectConstantSpeed(log);
  std::vector<double> recorded, repeated;
  for (Eigen::Index i = 0; i < log.size(); ++i) {
    const double time = log.time[i] - log.time[0];
    if (!selection.keep[i] || time > simulated.time[simulated.size() - 1]) continue;
    recorded.push_back(log.torque[i]);
    repeated.push_back(TorqueAt(simulated, time));
  }
  if (recorded.empty()) return "torque not compared: the simulation ends before the motion\n";

  using Column = Eigen::Map<const Eigen::VectorXd>;
  const auto n = static_cast<Eigen::Index>(recorded.size());
  const Metrics metrics =
      ComputeMetrics(Column(recorded.data(), n), Column(repeated.data(), n), 0, 0);
  return fmt::format(
      "simulated against recorded torque at {} samples of constant speed: RMSE {:.4g} {}, "
      "fit {:.2f} %\n",
      n, metrics.rmse, log.torque_unit, metrics.fit);
}

}  // namespace warmjoint::inline tools

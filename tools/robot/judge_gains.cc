#include "tools/robot/judge_gains.h"

#include <algorithm>
#include <cmath>

#include "identification/robot/explain_robot.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr double kKnownDeviations = 40;  // of the gain; why: 1.96 of them are 5 % of it
constexpr double kWrongByHalf = .5;      // share: of descriptions that tell no gain

/// A joint whose gain is known.
struct KnownGain {
  Index joint = 0;
  double value = 1;
};

bool IsBeyond(double gain, double factor) { return std::abs(std::log(gain)) > std::log(factor); }

/// Whether a gain is too small with all of its error, however little is known of it besides. A light joint whose description is wrong by a
/// tenth of its size may show one of any size.
bool IsBelowAThird(const GainGuess& guess) {
  constexpr double reach = 3;  // deviations
  const double gain = std::abs(guess.value), deviation = gain / std::max(guess.deviations, 1e-9);
  return gain + reach * deviation < 1 / kOtherUnit;
}

std::vector<KnownGain> KnownGains(const RobotSettings& settings, const PreparedRobot& robot) {
  std::vector<KnownGain> known;
  if (settings.inertials > kWrongByHalf) return known;
  for (const Index j : robot.Moving()) {
    const PreparedRobotJoint& joint = robot.joints[static_cast<std::size_t>(j)];
    if (!IsTorque(joint.columns) || joint.guess.deviations < kKnownDeviations) continue;
    known.push_back({j, std::abs(joint.guess.value)});
  }
  std::ranges::sort(known, {}, &KnownGain::value);
  return known;
}

void RefuseJoint(PreparedRobotJoint& joint, std::string sentence) {
  joint.status = Status::bad_data;
  joint.nothing = std::move(sentence);
}

}  // namespace

void JudgeSmallGains(const RobotSettings& settings, PreparedRobot& robot) {
  const std::vector<KnownGain> known = KnownGains(settings, robot);
  if (settings.inertials > kWrongByHalf) return;
  // one scale for all joints
  if (known.size() > 1) {
    const double middle = known[known.size() / 2].value;
    const bool alike = !IsBeyond(known.front().value / middle, kAlikeGains) &&
                       !IsBeyond(known.back().value / middle, kAlikeGains);
    if (alike && IsBeyond(middle, kOtherUnit)) {
      for (const Index j : robot.Moving()) {
        RefuseJoint(robot.joints[static_cast<std::size_t>(j)], ExplainScaleOfAll(middle));
      }
      return;
    }
  }
  for (const Index j : robot.Moving()) {
    PreparedRobotJoint& joint = robot.joints[static_cast<std::size_t>(j)];
    if (!IsTorque(joint.columns) || !IsBelowAThird(joint.guess)) continue;
    if (!IsBelowAThird(GuessGain(joint.columns, Description::as_prior))) continue;
    RefuseJoint(joint, ExplainScale(joint.columns.joint, std::abs(joint.guess.value)));
  }
}

void JudgeGains(const RobotSettings& settings, PreparedRobot& robot) {
  const std::vector<KnownGain> known = KnownGains(settings, robot);
  for (const auto& [j, gain] : known) {
    PreparedRobotJoint& joint = robot.joints[static_cast<std::size_t>(j)];
    const std::string& name = joint.columns.joint;
    if (IsBeyond(gain, kOtherUnit)) {
      RefuseJoint(joint, ExplainScale(name, gain));
    } else if (IsBeyond(gain, kAlikeGains) || IsBeyond(gain / robot.middle_gain, kAlikeGains)) {
      robot.notices.push_back(ExplainDoubtfulGain(name, gain));
    }
  }
}

}  // namespace warmjoint

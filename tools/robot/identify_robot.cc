#include <warmjoint/identify_robot.h>

#include <cmath>
#include <optional>
#include <vector>

#include "identification/robot/report_joint.h"
#include "identification/uncertainty/tails.h"
#include "models/recording/read_recording.h"
#include "tools/robot/at_once.h"
#include "tools/robot/identify_logs.h"
#include "tools/robot/judge_gains.h"
#include "tools/robot/payload.h"
#include "tools/robot/prepare_robot.h"

namespace warmjoint {
namespace {

using Eigen::Index;

RobotJointEstimate Answer(const PreparedRobotJoint& joint, const JointQuestion& question,
                          double holdout) {
  if (!joint.nothing.empty()) {
    return ReportNothing(joint.columns, joint.summary, joint.status, joint.nothing);
  }
  const JointFit fit = FitJoint(joint.columns, joint.guess, question);
  return ReportJoint(fit, joint.columns, joint.summary, HoldOutJoint(fit, joint.columns, holdout));
}

/// Looks for a load that nobody told, and frees the last link where one is shown or asked for.
std::optional<EstimatedParameter> TakeLoad(const RobotSettings& settings, const RobotWatch& watch,
                                           PreparedRobot& robot) {
  // without gravity in the torques none shows
  if (settings.tool.known == ToolKnown::given || settings.inertials == 0 ||
      robot.Moving().empty() || robot.gravity.held == GravityHeld::taken_off) {
    return std::nullopt;
  }
  if (watch) watch("looking for a load");
  std::vector<GainGuess> guesses;
  for (const PreparedRobotJoint& joint : robot.joints) guesses.push_back(joint.guess);
  const JointQuestion question{.middle_gain = robot.middle_gain,
                               .joints = static_cast<int>(robot.Moving().size())};
  const Payload payload =
      FindPayload(robot.data, robot.rows, guesses, robot.Moving(), question, settings.tool.known);
  if (payload.is_shown || settings.tool.known == ToolKnown::unknown) FreeLoad(robot);
  if (payload.is_shown) robot.notices.push_back(ExplainPayload(payload, settings.tool.known));
  return payload.mass;
}

/// What is known of gravity and a delay beyond the description.
void AddFindings(const PreparedRobot& prepared, RobotEstimate& answer) {
  const GravityFound& gravity = prepared.gravity;
  if (gravity.held == GravityHeld::turned) {
    const Eigen::Vector3d deviation = gravity.covariance.diagonal().cwiseSqrt();
    answer.gravity = {{gravity.vector.begin(), gravity.vector.end()},
                      {deviation.begin(), deviation.end()}};
  }
  answer.gravity_taken_off = gravity.held == GravityHeld::taken_off;
  if (!prepared.delay) return;
  const double delay = prepared.delay->value[0];
  const double deviation = std::sqrt(prepared.delay->covariance(0, 0));
  const double reach = kNormal95 * deviation;
  answer.delay = {.name = "delay",
                  .value = delay,
                  .unit = "s",
                  .std = deviation,
                  .interval95 = {{delay - reach, delay + reach}}};
}

}  // namespace

RobotEstimate IdentifyRobot(const std::filesystem::path& robot, const RobotSource& source,
                            const RobotSettings& settings, const RobotWatch& watch) {
  const auto tell = [&](const char* words) {
    if (watch) watch(words);
  };
  tell("reading the description and the log");
  PreparedRobot prepared = Prepare(ReadRobotData(robot, source, settings), settings, watch);
  JudgeSmallGains(settings, prepared);
  const std::optional<EstimatedParameter> payload = TakeLoad(settings, watch, prepared);
  JudgeGains(settings, prepared);
  const std::vector<Index> moving = prepared.Moving();
  const JointQuestion question{
      .middle_gain = prepared.middle_gain,
      // fields hold a friction that rises at low speed
      .slows = settings.fields.kinds.empty(),
      .joints = static_cast<int>(moving.size()),
      .fields = settings.fields,
  };

  tell("fitting each joint");
  RobotEstimate answer;
  answer.robot = robot.string();
  for (const RobotLogSource& log : source.logs) answer.log.push_back(log.name);
  answer.notices = prepared.notices;
  AddFindings(prepared, answer);
  answer.payload = payload;
  answer.joints.resize(prepared.joints.size());
  ForEachAtOnce(std::ssize(prepared.joints), [&](Index j) {
    const auto at = static_cast<std::size_t>(j);
    answer.joints[at] = Answer(prepared.joints[at], question, settings.holdout);
  });

  return answer;
}

RobotEstimate IdentifyRobot(const std::filesystem::path& robot, const RecordingSource& source,
                            const RobotSettings& settings, const RobotWatch& watch) {
  RobotSource logs{{}, source.read};
  for (const std::string& file : source.files) logs.logs.push_back({file});
  return IdentifyRobot(robot, logs, settings, watch);
}

RobotEstimate IdentifyRobot(const std::filesystem::path& robot,
                            const std::map<std::string, std::vector<double>>& columns,
                            const ReadSettings& read, const RobotSettings& settings,
                            const RobotWatch& watch) {
  return IdentifyRobot(robot, RobotSource{{{"log", ContentOf(columns)}}, read}, settings, watch);
}

}  // namespace warmjoint

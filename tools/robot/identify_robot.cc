#include <fmt/format.h>
#include <warmjoint/identify_robot.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "identification/robot/explain_robot.h"
#include "identification/robot/report_joint.h"
#include "models/recording/read_recording.h"
#include "tools/robot/at_once.h"
#include "tools/robot/find_faults.h"
#include "tools/robot/identify_logs.h"
#include "tools/robot/joint_data.h"
#include "tools/robot/payload.h"
#include "tools/robot/robot_data.h"

namespace warmjoint {
namespace {

using Eigen::Index;

/// The middle gain of the joints that know theirs; 1 where none does.
double MiddleGain(const std::vector<GainGuess>& guesses) {
  std::vector<double> sure;
  for (const GainGuess& one : guesses) {
    if (one.IsSure()) sure.push_back(std::abs(one.value));
  }
  if (sure.empty()) return 1;
  std::ranges::sort(sure);
  const std::size_t half = sure.size() / 2;
  return sure.size() % 2 == 1 ? sure[half] : (sure[half - 1] + sure[half]) / 2;
}

RobotJointSummary SummaryOf(const JointColumns& c, double travel) {
  RobotJointSummary summary;
  summary.joint = c.joint;
  summary.torque_unit = c.torque_unit;
  summary.travel = travel;
  summary.top_speed = c.top_speed;
  summary.minutes = static_cast<double>(c.samples.keep.count()) * c.step / 60;
  return summary;
}

/// A joint from its columns to its estimate, in two parts: the gain first, since those of all joints are a prior of each.
struct Joint {
  JointColumns columns;
  RobotJointSummary summary;
  std::string nothing;  // why its log tells nothing
  bool dead = false;    // its torque cannot be used
  GainGuess guess;
  bool is_turned = false;  // its torque, which is fitted with the other sign
};

Joint Prepare(const RobotData& data, const RobotRows& rows, Index j) {
  Joint joint{ColumnsOf(data, rows, j), {}, {}, false, {}, false};
  double travel = 0;
  for (const RobotSamples& s : rows.samples) travel = std::max(travel, s.travel[j]);
  joint.summary = SummaryOf(joint.columns, travel);
  joint.nothing = WhyNothing(joint.columns, travel);
  for (const RobotLog& log : data.logs) {
    const std::string& dead = log.dead[static_cast<std::size_t>(j)];
    if (dead.empty()) continue;
    joint.dead = true;
    joint.nothing = dead;
  }
  if (!joint.nothing.empty()) return joint;
  joint.guess = GuessGain(joint.columns);
  if (joint.guess.IsTurned()) {
    // friction that drives is a torque whose sign is turned
    joint.is_turned = true;
    joint.columns.samples.torque *= -1;
    joint.guess.value *= -1;
  }
  return joint;
}

RobotJointEstimate Answer(const Joint& joint, const JointQuestion& question, double holdout) {
  if (!joint.nothing.empty()) {
    const Status status = joint.dead ? Status::bad_data : Status::not_identifiable;
    return ReportNothing(joint.columns, joint.summary, status, joint.nothing);
  }
  const JointFit fit = FitJoint(joint.columns, joint.guess, question);
  return ReportJoint(fit, joint.columns, joint.summary, HoldOutJoint(fit, joint.columns, holdout));
}

}  // namespace

RobotEstimate IdentifyRobot(const std::filesystem::path& robot, const RobotSource& source,
                            const RobotSettings& settings, const RobotWatch& watch) {
  const auto tell = [&](const char* words) {
    if (watch) watch(words);
  };
  tell("reading the description and the log");
  const RobotData data = ReadRobotData(robot, source, settings);
  tell("rigid torque along the motion");
  RobotRows rows = MakeRows(data, settings);
  const bool is_asked = settings.tool.known == ToolKnown::unknown;
  const Eigen::MatrixXd described = rows.deviations;
  if (is_asked) rows.deviations = FreeLastLink(data, described);

  const Index n = std::ssize(data.robot.joints);
  std::vector<Joint> joints(static_cast<std::size_t>(n));
  ForEachAtOnce(n, [&](Index j) { joints[static_cast<std::size_t>(j)] = Prepare(data, rows, j); });
  std::vector<GainGuess> guesses;
  for (Index j = 0; j < n; ++j) {
    const Joint& joint = joints[static_cast<std::size_t>(j)];
    guesses.push_back(joint.guess);
    // what follows sees it with the sign that it is fitted with
    for (RobotSamples& s : rows.samples) s.torque.col(j) *= joint.is_turned ? -1 : 1;
  }
  JointQuestion question;
  question.middle_gain = MiddleGain(guesses);
  if (is_asked) {
    std::vector<double> open;
    for (const Joint& joint : joints) open.push_back(OpenShare(joint.columns));
    const LoadedGains loaded = GainsUnderLoad(guesses, open);
    question.middle_gain = loaded.middle;
    for (std::size_t j = 0; j < joints.size(); ++j) joints[j].guess = loaded.guesses[j];
  }
  question.fields = settings.fields;
  // fields hold a friction that rises at low speed
  question.slows = settings.fields.kinds.empty();
  question.joints = static_cast<int>(
      std::ranges::count_if(joints, [](const Joint& joint) { return joint.nothing.empty(); }));

  tell("looking for faults of the log");
  for (const RobotFault& fault : FindFaults(data, rows, settings.gear)) {
    // the rigid torque of every joint follows from the positions of all
    const std::string& worst =
        data.robot.joints[static_cast<std::size_t>(fault.joints.front())].name;
    for (Joint& joint : joints) {
      if (!joint.nothing.empty()) continue;
      joint.dead = true;
      joint.nothing = fmt::format("{}: with that undone the residual of {} falls by more than half",
                                  fault.sentence, worst);
    }
  }

  tell("fitting each joint");
  RobotEstimate answer;
  answer.robot = robot.string();
  for (const RobotLogSource& log : source.logs) answer.log.push_back(log.name);
  answer.notices = data.notices;
  answer.joints.resize(joints.size());
  for (const Joint& joint : joints) {
    if (joint.is_turned) answer.notices.push_back(ExplainTurnedTorque(joint.columns.joint));
  }
  ForEachAtOnce(n, [&](Index j) {
    const auto at = static_cast<std::size_t>(j);
    answer.joints[at] = Answer(joints[at], question, settings.holdout);
  });

  // a load that nobody told
  if (settings.tool.known == ToolKnown::given || settings.inertials == 0) return answer;
  tell("looking for a load");
  std::vector<Index> fitted;
  for (Index j = 0; j < n; ++j) {
    if (joints[static_cast<std::size_t>(j)].nothing.empty()) fitted.push_back(j);
  }
  if (fitted.empty()) return answer;
  rows.deviations = described;
  const Payload payload = FindPayload(data, rows, guesses, fitted, question, settings.tool.known);
  if (payload.is_shown) answer.notices.push_back(ExplainPayload(payload, settings.tool.known));
  answer.payload = payload.mass;
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

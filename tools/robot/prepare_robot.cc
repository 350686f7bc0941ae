#include "tools/robot/prepare_robot.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "identification/robot/explain_robot.h"
#include "identification/robot/report_joint.h"
#include "tools/robot/at_once.h"
#include "tools/robot/find_faults.h"
#include "tools/robot/payload.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kGravityRounds = 2;   // why: the first is within a degree
constexpr double kLeastDelay = .1;  // of a step of the log; why: a log's own clock is no finer
constexpr int kDelayRounds = 4;     // why: each leaves a tenth of the last one's error or less
constexpr double kDelayShare = .1;  // of its deviation, below which a further step is none

/// The middle gain of the joints that know theirs; 1 where none does.
double MiddleGain(const std::vector<PreparedRobotJoint>& joints) {
  std::vector<double> sure;
  for (const PreparedRobotJoint& one : joints) {
    if (one.guess.IsSure()) sure.push_back(std::abs(one.guess.value));
  }
  if (sure.empty()) return 1;
  std::ranges::sort(sure);
  const std::size_t half = sure.size() / 2;
  return sure.size() % 2 == 1 ? sure[half] : (sure[half - 1] + sure[half]) / 2;
}

PreparedRobotJoint JointOf(const RobotData& data, const RobotRows& rows, Index j) {
  PreparedRobotJoint joint;
  joint.columns = ColumnsOf(data, rows, j);
  double travel = 0;
  for (const RobotSamples& s : rows.samples) travel = std::max(travel, s.travel[j]);
  joint.summary.joint = joint.columns.joint;
  joint.summary.torque_unit = joint.columns.torque_unit;
  joint.summary.travel = travel;
  joint.summary.top_speed = joint.columns.top_speed;
  joint.summary.minutes =
      static_cast<double>(joint.columns.samples.keep.count()) * joint.columns.step / 60;
  joint.nothing = WhyNothing(joint.columns, travel);
  for (const RobotLog& log : data.logs) {
    const std::string& dead = log.dead[static_cast<std::size_t>(j)];
    if (dead.empty()) continue;
    joint.status = Status::bad_data;
    joint.nothing = dead;
  }
  if (joint.nothing.empty()) joint.guess = GuessGain(joint.columns);
  return joint;
}

/// The joints' columns and gains anew.
void MakeJoints(PreparedRobot& robot) {
  const Index n = std::ssize(robot.data.robot.joints);
  robot.joints.assign(static_cast<std::size_t>(n), {});
  ForEachAtOnce(n, [&](Index j) {
    robot.joints[static_cast<std::size_t>(j)] = JointOf(robot.data, robot.rows, j);
  });
}

/// Undoes signs of torques by which friction would drive.
void TurnTorques(PreparedRobot& robot) {
  std::vector<Index> turned;
  bool any_brakes = false;
  for (const Index j : robot.Moving()) {
    const GainGuess& guess = robot.joints[static_cast<std::size_t>(j)].guess;
    if (guess.IsTurned()) turned.push_back(j);
    any_brakes = any_brakes || guess.Brakes();
  }
  // where no joint brakes, those that do not tell are turned as the others
  const bool all = turned.size() > 1 && !any_brakes;
  if (all) turned = robot.Moving();
  if (all) robot.notices.emplace_back(kAllTorquesTurned);
  for (const Index j : turned) {
    PreparedRobotJoint& joint = robot.joints[static_cast<std::size_t>(j)];
    if (!all) robot.notices.push_back(ExplainTurnedTorque(joint.columns.joint));
    joint.columns.samples.torque *= -1;
    joint.guess.value *= -1;
    joint.guess.braking *= -1;
    for (RobotSamples& s : robot.rows.samples) s.torque.col(j) *= -1;
    for (RobotLog& log : robot.data.logs) log.torque.col(j) *= -1;
  }
}

/// The joints that move, as fits of what they have in common get them.
struct Together {
  std::vector<const JointColumns*> columns;
  std::vector<GainGuess> guesses;
  double middle = 1;
};

Together TogetherOf(const PreparedRobot& robot) {
  Together all;
  for (const Index j : robot.Moving()) {
    all.columns.push_back(&robot.joints[static_cast<std::size_t>(j)].columns);
    all.guesses.push_back(robot.joints[static_cast<std::size_t>(j)].guess);
  }
  all.middle = MiddleGain(robot.joints);
  return all;
}

/// A turned gravity found more finely, with a description that may be wrong, and what stays open of it.
void RefineGravity(GravityFound& found, PreparedRobot& robot) {
  RobotGravity& gravity = robot.rows.gravity;
  const double g = found.vector.norm();
  for (int round = 0; round < kGravityRounds; ++round) {
    gravity.in_torque = gravity.at_joints = found.vector;
    gravity.open.resize(3, 0);
    MakeJoints(robot);
    const MatrixXd across = Across(found.vector.normalized());
    const Together all = TogetherOf(robot);
    const std::vector<Index> moving = robot.Moving();
    const CommonFit turn = FitCommon(
        all.columns, all.guesses, all.middle, [&](std::size_t at, const VectorXd&) -> MatrixXd {
          return all.guesses[at].Or(all.middle) *
                 GravityColumns(robot.data, robot.rows, moving[at]) * across;
        });
    if (turn.value.size() == 0) return;
    found.vector = g * (found.vector + across * turn.value).normalized();
    found.covariance = across * turn.covariance * across.transpose();
    gravity.open = across * Eigen::LLT<MatrixXd>(turn.covariance).matrixL().toDenseMatrix();
  }
  gravity.in_torque = gravity.at_joints = found.vector;
}

/// Gravity as the torques hold it.
void TakeGravity(PreparedRobot& robot) {
  GravityFound& found = robot.gravity;
  if (found.held == GravityHeld::taken_off) {
    robot.rows.gravity.in_torque.setZero();
  } else {
    RefineGravity(found, robot);
  }
  robot.notices.push_back(ExplainGravity(found, robot.rows.gravity.described));
  MakeJoints(robot);
}

/// Positions as they were `delay` s before, by cubics through neighbours (Catmull, Rom).
MatrixXd Earlier(const MatrixXd& position, double step, double delay) {
  const Index n = position.rows();
  MatrixXd moved(n, position.cols());
  for (Index i = 0; i < n; ++i) {
    const double at =
        std::clamp(static_cast<double>(i) - delay / step, 0.0, static_cast<double>(n - 1));
    const Index k = std::min(static_cast<Index>(at), n - 2);
    const double s = at - static_cast<double>(k);
    const auto row = [&](Index r) { return position.row(std::clamp<Index>(r, 0, n - 1)); };
    moved.row(i) = row(k) + .5 * s *
                                (row(k + 1) - row(k - 1) +
                                 s * (2 * row(k - 1) - 5 * row(k) + 4 * row(k + 1) - row(k + 2) +
                                      s * (3 * (row(k) - row(k + 1)) + row(k + 2) - row(k - 1))));
  }
  return moved;
}

CommonFit DelayOf(const PreparedRobot& robot) {
  const Together all = TogetherOf(robot);
  return FitDelay(all.columns, all.guesses, all.middle);
}

/// The rows of logs whose positions have moved.
void MakeRowsAnew(const RobotSettings& settings, PreparedRobot& robot) {
  RobotRows rows = MakeRows(robot.data, settings);
  rows.gravity = robot.rows.gravity;
  rows.deviations = robot.rows.deviations;
  robot.rows = std::move(rows);
  MakeJoints(robot);
}

/// The columns of a joint, with what stays open of a delay.
JointColumns ColumnsOf(const PreparedRobot& robot, Index j) {
  JointColumns columns = ColumnsOf(robot.data, robot.rows, j);
  const MatrixXd& late = robot.joints[static_cast<std::size_t>(j)].late;
  if (late.size() > 0) columns.AddDirections(late, MatrixXd::Zero(late.rows(), late.cols()));
  return columns;
}

/// Keeps what stays open of a delay, for all joints the same.
void KeepOpenDelay(const CommonFit& delay, PreparedRobot& robot) {
  const double deviation = std::sqrt(delay.covariance(0, 0));
  const double middle = MiddleGain(robot.joints);
  std::size_t at = 0;
  for (const Index j : robot.Moving()) {
    PreparedRobotJoint& joint = robot.joints[static_cast<std::size_t>(j)];
    joint.late = delay.columns[at++] * (deviation / joint.guess.Or(middle));
    joint.columns = ColumnsOf(robot, j);
  }
}

/// Undoes a delay of all torques, where the log shows one and is explained better without it.
void UndoDelay(const RobotSettings& settings, PreparedRobot& robot) {
  const CommonFit first = DelayOf(robot);
  const double least = kLeastDelay * robot.data.logs.front().step;
  if (!first.is_shown || std::abs(first.value[0]) < least) return;
  PreparedRobot undone = robot;
  CommonFit last = first;
  double delay = 0;
  for (int round = 0; round < kDelayRounds; ++round) {
    const double more = last.value[0];
    delay += more;
    for (RobotLog& log : undone.data.logs) log.position = Earlier(log.position, log.step, more);
    MakeRowsAnew(settings, undone);
    last = DelayOf(undone);
    if (std::abs(last.value[0]) < kDelayShare * std::sqrt(last.covariance(0, 0))) break;
  }
  if (!(last.left < first.left)) return;
  robot = std::move(undone);
  last.value[0] += delay;
  const double deviation = std::sqrt(last.covariance(0, 0));
  robot.notices.push_back(ExplainDelayOfAll(last.value[0], deviation));

  KeepOpenDelay(last, robot);
  robot.delay = std::move(last);
}

}  // namespace

std::vector<Index> PreparedRobot::Moving() const {
  std::vector<Index> moving;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].nothing.empty()) moving.push_back(static_cast<Index>(j));
  }
  return moving;
}

PreparedRobot Prepare(RobotData data, const RobotSettings& settings, const RobotWatch& watch) {
  const auto tell = [&](const char* words) {
    if (watch) watch(words);
  };
  PreparedRobot robot;
  robot.data = std::move(data);
  robot.notices = robot.data.notices;
  tell("rigid torque along the motion");
  robot.rows = MakeRows(robot.data, settings);
  MakeJoints(robot);
  TurnTorques(robot);

  // gravity's direction against a fault of the columns
  tell("looking for faults of the log");
  GravityFound gravity;
  if (settings.gravity.empty()) gravity = FindGravity(robot.data, robot.rows, robot.Moving());
  const std::vector<RobotFault> faults = FindFaults(robot.data, robot.rows, settings.gear);
  const bool is_fault = !faults.empty() && faults.front().falls > gravity.falls;
  if (is_fault) {
    const RobotFault& fault = faults.front();
    const auto worst = static_cast<std::size_t>(fault.joints.front());
    for (const Index j : robot.Moving()) {
      PreparedRobotJoint& joint = robot.joints[static_cast<std::size_t>(j)];
      joint.status = Status::bad_data;
      joint.nothing = fmt::format("{}: with that undone the residual of {} falls by more than half",
                                  fault.sentence, robot.data.robot.joints[worst].name);
    }
    return robot;
  }
  if (gravity.held != GravityHeld::described) {
    robot.gravity = gravity;
    TakeGravity(robot);
  }
  tell("looking for a delay");
  UndoDelay(settings, robot);

  robot.middle_gain = MiddleGain(robot.joints);
  return robot;
}

void FreeLoad(PreparedRobot& robot) {
  robot.rows.deviations = FreeLastLink(robot.data, robot.rows.deviations);
  const std::vector<Index> moving = robot.Moving();
  std::vector<const JointColumns*> columns;
  std::vector<GainGuess> guesses;
  for (const Index j : moving) {
    PreparedRobotJoint& joint = robot.joints[static_cast<std::size_t>(j)];
    joint.columns = ColumnsOf(robot, j);
    columns.push_back(&joint.columns);
    guesses.push_back(joint.guess);
  }
  const LoadedGains loaded = GainsUnderLoad(guesses, columns);
  robot.middle_gain = loaded.middle;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    robot.joints[static_cast<std::size_t>(moving[i])].guess = loaded.guesses[i];
  }
}

}  // namespace warmjoint

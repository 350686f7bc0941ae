#include "tools/robot/robot_data.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "identification/robot/robot_joint.h"
#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"
#include "models/recording/read_recording.h"
#include "models/robot_log/robot_columns.h"

namespace warmjoint {
namespace {

constexpr double kLargestFactor = 1e3;  // of a coupling; why: no gear between joints has more

using Eigen::Index;

/// Beyond which no joint stands whose description has no narrower limits: four turns, as the last joints of some arms have.
constexpr double kFarthest = 4 * 2 * std::numbers::pi;  // rad
constexpr double kBesideLimit = .5;  // rad that a joint may stand beyond its limits in a log

/// The tables of all logs, and the columns of the joints, by the first of them.
struct Tables {
  std::vector<FileContent> contents;
  RobotColumns columns;
};

Tables ReadTables(const RobotSource& source, const std::vector<std::string>& joints) {
  const auto find = [&](const FileContent& content, const Place& place) {
    std::vector<std::string> names;
    for (const FileColumn& column : content.columns) names.push_back(column.name);
    return FindRobotColumns(names, joints, source.read.map, place);
  };
  if (source.logs.empty()) Refuse({"log"}, "is an empty list; give at least one");
  Tables tables;
  for (const RobotLogSource& log : source.logs) {
    const bool is_first = tables.contents.empty();
    const auto known = [&](const FileContent&, const Place&) { return tables.columns; };
    tables.contents.push_back(
        ReadRobotTable(log, source.read, is_first ? FindLogColumns(find) : FindLogColumns(known)));
    // a file may be read by a process of its own, which keeps what it found
    if (is_first) tables.columns = find(tables.contents.front(), {InputName(log.name)});
  }
  return tables;
}

/// A rotary joint that stands where it could not, were its positions in rad.
struct BeyondRange {
  std::string joint;
  bool in_degrees = false;  // whether the log is taken in degrees therefore
};

/// Positions are in degrees where a joint is beyond its range in rad and all are within theirs in degrees, unless no joint would move then.
/// Nothing where the log may be in rad.
std::optional<BeyondRange> FindBeyondRange(const RobotDescription& robot, const RobotLog& log) {
  std::optional<BeyondRange> beyond;
  bool impossible = false, moves = false;
  for (Index j = 0; j < log.position.cols(); ++j) {
    const ModelJoint& one = robot.joints[static_cast<std::size_t>(j)];
    if (one.kind != JointKind::rotary) continue;
    double farthest = kFarthest;
    if (one.range) {
      const auto& [lower, upper] = *one.range;
      farthest = std::min(farthest, std::max(std::abs(lower), std::abs(upper)) + kBesideLimit);
    }
    const auto position = log.position.col(j);
    const double reached = position.cwiseAbs().maxCoeff(), degree = std::numbers::pi / 180;
    // a count of something else is no degree either
    if (reached * degree > farthest) return std::nullopt;
    if (reached > farthest && !beyond) beyond = BeyondRange{one.name};
    impossible = impossible || reached > kFarthest;
    moves = moves || (position.maxCoeff() - position.minCoeff()) * degree >= kLeastTravel;
  }
  if (beyond) beyond->in_degrees = impossible || moves;
  return beyond;
}

/// Takes the options of single joints, and tells the unit of each torque.
void TakeOptions(const RobotSettings& settings, RobotData& data) {
  const Index n = std::ssize(data.robot.joints);
  for (Index j = 0; j < n; ++j) {
    const ModelJoint& joint = data.robot.joints[static_cast<std::size_t>(j)];
    const double constant = NumberOf(settings.torque_constant, joint.name, 0);
    const std::string& unit = data.logs.front().torque_unit;
    if (constant != 0 && unit != "A" && !unit.empty()) {
      Refuse(
          {"--torque-constant"},
          "makes torque of a current, and the torques of the log are in {}; give --unit torque=A "
          "where they are in amperes",
          unit);
    }
    const double factor =
        NumberOf(settings.torque_scale, joint.name, 1) * (constant != 0 ? constant : 1);
    for (RobotLog& log : data.logs) {
      log.torque.col(j) *= factor;
      log.position.col(j) *= NumberOf(settings.position_scale, joint.name, 1);
      log.position.col(j).array() -= NumberOf(settings.zero, joint.name, 0);
    }
    const bool is_torque = constant != 0 || unit == "N.m" || unit == "N" || unit.empty();
    data.torque_units.push_back(is_torque ? std::string(kTorqueUnit.For(joint.kind)) : unit);
  }
}

/// Refuses numbers that no joint has. name: as the option is called
void CheckRange(const NumberOfJoints& numbers, const char* name, double least, double most) {
  for (const auto& [joint, number] : numbers) {
    const double size = std::abs(number);
    if (size >= least && size <= most) continue;
    Refuse({name}, "{}{}is {}; its size must be from {:g} to {:g}",
           joint.empty() ? "" : Excerpt(joint), joint.empty() ? "" : " ", number, least, most);
  }
}

/// Refuses settings that mean nothing, before anything is read.
void CheckSettings(const RobotSettings& settings) {
  constexpr double most_gear =
      1e5;  // why: ten times the turns of a motor for 1 m of a screw of 1 mm
  constexpr double most_factor =
      1e9;                           // why: from a unit to one of a thousand millionth, either way
  constexpr double most_mass = 1e6;  // kg; why: a thousand times what any robot carries
  constexpr double most_length = 1e3;   // m; why: the same
  constexpr double most_gravity = 300;  // m/s^2; why: more than on any planet
  std::set<std::string> known;
  for (const std::string& joint : settings.joints) {
    if (known.insert(joint).second) continue;
    Refuse({"--joints"}, "names '{}' twice; give each joint of the log once", Excerpt(joint));
  }
  CheckRange(settings.gear, "--gear", 0, most_gear);
  CheckRange(settings.torque_constant, "--torque-constant", 1 / most_factor, most_factor);
  CheckRange(settings.torque_scale, "--scale of the torque", 1 / most_factor, most_factor);
  CheckRange(settings.position_scale, "--scale of the position", 1 / most_factor, most_factor);
  CheckRange(settings.zero, "--zero", 0, most_length);
  CheckRange(settings.at, "--at", 0, most_length);
  for (const double one : settings.gravity) {
    if (std::abs(one) <= most_gravity) continue;
    Refuse({"--gravity"}, "has {}; it must be from -{:g} to {:g} m/s^2", one, most_gravity,
           most_gravity);
  }
  const RobotTool& tool = settings.tool;
  if (!(tool.mass >= 0 && tool.mass <= most_mass)) {
    Refuse({"--tool"}, "mass is {}; it must be from 0 to {:g} kg", tool.mass, most_mass);
  }
  for (const double place : tool.centre) {
    if (std::abs(place) <= most_length) continue;
    Refuse({"--tool"}, "com has {}; it must be from -{:g} to {:g} m", place, most_length,
           most_length);
  }
}

void CheckNames(const NumberOfJoints& numbers, const char* option, const RobotDescription& robot) {
  std::vector<std::string> names;
  for (const ModelJoint& joint : robot.joints) names.push_back(joint.name);
  for (const auto& [joint, value] : numbers) {
    if (joint.empty() || std::ranges::find(names, joint) != names.end()) continue;
    Refuse({option}, "the log holds no joint '{}'{}", Excerpt(joint), Suggestion(joint, names));
  }
}

}  // namespace

double NumberOf(const NumberOfJoints& numbers, const std::string& joint, double otherwise) {
  for (const std::string& name : {joint, std::string()}) {
    if (const auto found = numbers.find(name); found != numbers.end()) return found->second;
  }
  return otherwise;
}

Eigen::MatrixXd ReadCoupling(const std::vector<std::string>& texts,
                             const std::vector<ModelJoint>& joints) {
  const Index n = std::ssize(joints);
  Eigen::MatrixXd coupling = Eigen::MatrixXd::Identity(n, n);
  std::vector<std::string> names;
  for (const ModelJoint& joint : joints) names.push_back(joint.name);
  const auto place = [&](const std::string& name) {
    const auto at = std::ranges::find(names, name);
    if (at == names.end()) {
      Refuse({"--coupling"}, "the log holds no joint '{}'{}", Excerpt(name),
             Suggestion(name, names));
    }
    return at - names.begin();
  };
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) {
      Refuse({"--coupling"}, "is '{}'; it must say by what a motor turns, as J6=J5+J6",
             Excerpt(text));
    }
    const Index row = place(text.substr(0, equals));
    coupling.row(row).setZero();
    for (std::size_t at = equals + 1; at < text.size();) {
      // a sign, perhaps a factor, a name
      double factor = 1;
      if (text[at] == '+' || text[at] == '-') factor = text[at++] == '-' ? -1 : 1;
      const std::size_t end = std::min(text.find_first_of("+-", at), text.size());
      std::string term = text.substr(at, end - at);
      if (const std::size_t times = term.find('*'); times != std::string::npos) {
        const auto number = ParseNumber(term.substr(0, times));
        if (!number || !(std::abs(*number) <= kLargestFactor)) {
          Refuse({"--coupling"}, "'{}' is no factor from {:g} to {:g}",
                 Excerpt(term.substr(0, times)), -kLargestFactor, kLargestFactor);
        }
        factor *= *number;
        term = term.substr(times + 1);
      }
      coupling(row, place(term)) += factor;
      at = end;
    }
  }
  if (std::abs(coupling.determinant()) < 1e-9) {
    Refuse({"--coupling"},
           "leaves motors that turn alike: no motion of the joints follows from theirs");
  }
  return coupling;
}

RobotData ReadRobotData(const std::filesystem::path& robot, const RobotSource& source,
                        const RobotSettings& settings) {
  if (source.logs.empty()) Refuse({"log"}, "no recording is given; give at least one");
  CheckSettings(settings);
  ReadModel model = ReadRobotModel(robot);
  const std::vector<std::string> joints = settings.joints.empty() ? model.joints : settings.joints;
  Tables tables = ReadTables(source, joints);
  const RobotColumns& columns = tables.columns;
  ReadSettings read = source.read;
  if (!settings.gravity.empty()) std::ranges::copy(settings.gravity, model.model->opt.gravity);
  RobotData data{.robot = DescribeRobot(std::move(model), columns.joints, settings.at),
                 .logs = {},
                 .torque_units = {},
                 .coupling = {},
                 .notices = columns.notices};
  data.notices.insert(data.notices.begin(), data.robot.notices.begin(), data.robot.notices.end());
  data.coupling = ReadCoupling(settings.coupling, data.robot.joints);
  for (const auto& [numbers, option] :
       {std::pair(&settings.gear, "--gear"),
        std::pair(&settings.torque_constant, "--torque-constant"),
        std::pair(&settings.torque_scale, "--scale"),
        std::pair(&settings.position_scale, "--scale"), std::pair(&settings.zero, "--zero")}) {
    CheckNames(*numbers, option, data.robot);
  }
  if (columns.torque_is_current && !read.unit.contains("torque")) {
    read.unit["torque"] = "A";
    data.notices.push_back(
        fmt::format("'{}' is taken as a current in A by its name (--unit torque=...)",
                    columns.maps[0].at("torque")));
  }

  std::vector<JointKind> kinds;
  for (const ModelJoint& joint : data.robot.joints) kinds.push_back(joint.kind);
  const auto read_all = [&] {
    data.logs.clear();
    for (std::size_t i = 0; i < source.logs.size(); ++i) {
      data.logs.push_back(
          ReadRobotLog(InputName(source.logs[i].name), tables.contents[i], read, columns, kinds));
    }
  };
  read_all();
  const auto beyond = FindBeyondRange(data.robot, data.logs.front());
  if (!read.unit.contains("position") && beyond && beyond->in_degrees) {
    read.unit["position"] = "deg";
    read_all();
    data.notices.push_back(
        fmt::format("positions are taken in degrees: in rad {} would stand where it cannot (--unit "
                    "position=rad)",
                    beyond->joint));
  } else if (!read.unit.contains("position") && beyond) {
    data.notices.push_back(
        fmt::format("positions are taken in rad, where {} leaves its range, since in degrees no "
                    "joint would move (--unit position=deg)",
                    beyond->joint));
  }
  for (const RobotLog& log : data.logs) {
    for (const std::string& note : log.notes) data.notices.push_back(log.source + ": " + note);
    for (std::size_t j = 0; j < log.dead.size(); ++j) {
      if (log.dead[j].empty()) continue;
      data.notices.push_back(
          fmt::format("{} is left out: {}", data.robot.joints[j].name, log.dead[j]));
    }
  }
  TakeOptions(settings, data);
  return data;
}

}  // namespace warmjoint

#include "models/robot_log/robot_log.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "models/foundation/atomic_file.h"
#include "models/recording/measurements.h"
#include "models/recording/table_format.h"

namespace warmjoint {
namespace {

using Eigen::Index;

/// x at other times, straight between its own; beyond them its ends. time, x: [M]; at: [N], ascending.
Eigen::VectorXd Interpolated(const Eigen::VectorXd& time, const Eigen::VectorXd& x,
                             const Eigen::VectorXd& at) {
  Eigen::VectorXd values(at.size());
  Index k = 0;
  for (Index i = 0; i < at.size(); ++i) {
    while (k + 2 < time.size() && time[k + 1] < at[i]) ++k;
    const double share = std::clamp((at[i] - time[k]) / (time[k + 1] - time[k]), 0.0, 1.0);
    values[i] = x[k] + share * (x[k + 1] - x[k]);
  }
  return values;
}

/// Samples that lie in a gap of more than a few steps.
Eigen::Array<bool, Eigen::Dynamic, 1> OutsideGaps(const Eigen::VectorXd& time, double step,
                                                  const Eigen::VectorXd& at) {
  constexpr double steps = 5;  // why 5: a straight line over fewer follows what a drive can do
  Eigen::Array<bool, Eigen::Dynamic, 1> logged =
      Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(at.size(), true);
  Index k = 0;
  for (Index i = 0; i < at.size(); ++i) {
    while (k + 2 < time.size() && time[k + 1] < at[i]) ++k;
    logged[i] = time[k + 1] - time[k] <= steps * step;
  }
  return logged;
}

/// The joint's samples; where its torque is of no use those of its position alone, with the reason.
Measurements ReadOne(const ReadJoint& read, ReadSettings settings, std::string& dead) {
  try {
    return read(settings);
  } catch (const BadInput& refusal) {
    // a position that cannot be read either is refused for good
    settings.map["torque"] = settings.map["position"];
    settings.unit.erase("torque");
    settings.unit["torque"] = "raw";
    settings.scale.erase("torque");
    settings.torque_constant = 0;
    Measurements position = read(settings);
    dead = refusal.what();
    return position;
  }
}

}  // namespace

std::vector<std::string> NamesOfColumns(const std::string& file, const ReadSettings& settings) {
  if (!settings.columns.empty()) return settings.columns;
  const std::string extension = std::filesystem::path(file).extension().string();
  for (const char* binary : {".h5", ".hdf5", ".mat"}) {
    if (extension == binary) return {};
  }
  std::string text = ReadWholeFile(file);
  if (const auto utf8 = FromUtf16(text)) text = *utf8;
  return FindTable(text, InputName(file), false).names;
}

RobotLog ReadRobotLog(const ReadJoint& read, const ReadSettings& settings,
                      const RobotColumns& columns, const std::vector<JointKind>& kinds) {
  RobotLog log;
  const Index n = std::ssize(columns.maps);
  std::vector<Measurements> joints;
  for (Index j = 0; j < n; ++j) {
    ReadSettings own = settings;
    own.map = columns.maps[static_cast<std::size_t>(j)];
    own.joint = kinds[static_cast<std::size_t>(j)];
    // a unit of angles is none of a slide's
    if (own.joint == JointKind::linear) own.unit.erase("position");
    joints.push_back(ReadOne(read, own, log.dead.emplace_back()));
    for (const std::string& note : joints.back().notes) {
      if (std::ranges::find(log.notes, note) == log.notes.end()) log.notes.push_back(note);
    }
  }

  // one clock, even in time, as long as all joints are there
  const Measurements& first = joints.front();
  log.source = first.source;
  double begin = first.time[0], end = first.time[first.size() - 1];
  for (const Measurements& one : joints) {
    begin = std::max(begin, one.time[0]);
    end = std::min(end, one.time[one.size() - 1]);
  }
  log.step = MedianStep(first.time);
  if (!(end - begin > 10 * log.step)) {
    Refuse({log.source}, "its joints have no time in common that would hold 10 samples");
  }
  const auto samples = static_cast<Index>(std::floor((end - begin) / log.step * (1 + 1e-12))) + 1;
  log.time =
      begin + Eigen::ArrayXd::LinSpaced(samples, 0, static_cast<double>(samples - 1)) * log.step;
  log.logged = OutsideGaps(first.time, log.step, log.time);
  log.position.resize(samples, n);
  log.torque.resize(samples, n);
  for (Index j = 0; j < n; ++j) {
    const Measurements& one = joints[static_cast<std::size_t>(j)];
    const bool alive = log.dead[static_cast<std::size_t>(j)].empty();
    log.position.col(j) = Interpolated(one.time, one.position, log.time);
    log.torque.col(j) = Interpolated(one.time, one.torque, log.time);
    if (alive) log.torque_unit = one.torque_unit;
  }
  return log;
}

}  // namespace warmjoint

#include "models/robot_log/robot_log.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "models/foundation/excerpt.h"
#include "models/recording/measurements.h"
#include "models/recording/read_recording.h"

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

/// False for samples that lie in a gap of more than a few steps, or beyond the ends.
Eigen::Array<bool, Eigen::Dynamic, 1> OutsideGaps(const Eigen::VectorXd& time,
                                                  const Eigen::VectorXd& at) {
  constexpr double steps = 5;  // why 5: a straight line over fewer follows what a drive can do
  const double longest = steps * MedianStep(time);
  const double first = time[0] - longest, last = time[time.size() - 1] + longest;
  Eigen::Array<bool, Eigen::Dynamic, 1> logged(at.size());
  Index k = 0;
  for (Index i = 0; i < at.size(); ++i) {
    while (k + 2 < time.size() && time[k + 1] < at[i]) ++k;
    logged[i] = at[i] >= first && at[i] <= last && time[k + 1] - time[k] <= longest;
  }
  return logged;
}

/// In how many rows a slower clock repeats each value; 1 where none does. A run of equal values is a multiple of it in 19 of 20 cases, where that
/// of a coarse resolution has any length.
Index RepeatsOf(const Eigen::VectorXd& x) {
  constexpr double share = .95;
  constexpr std::size_t fewest = 20;  // runs
  std::vector<Index> runs;
  for (Index i = 1, begin = 0; i < x.size(); ++i) {
    if (x[i] == x[i - 1]) continue;
    // the first may have begun before the log
    if (begin > 0) runs.push_back(i - begin);
    begin = i;
  }
  if (runs.size() < fewest) return 1;
  std::vector<Index> sorted = runs;
  std::ranges::nth_element(sorted, sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2));
  const Index middle = sorted[sorted.size() / 2];
  const auto fit = std::ranges::count_if(runs, [&](Index run) { return run % middle == 0; });
  return static_cast<double>(fit) >= share * static_cast<double>(runs.size()) ? middle : 1;
}

/// A torque that a slower clock repeats, at the rows where it is new.
void TakeNewValues(Measurements& torque, std::vector<std::string>& notes) {
  const Index repeats = RepeatsOf(torque.torque);
  if (repeats < 2) return;
  std::vector<Index> rows{0};
  for (Index i = 1; i < torque.torque.size(); ++i) {
    const bool is_new = torque.torque[i] != torque.torque[i - 1];
    if (is_new || i - rows.back() >= repeats) rows.push_back(i);
  }
  torque.time = Eigen::VectorXd(torque.time(rows));
  torque.torque = Eigen::VectorXd(torque.torque(rows));
  notes.push_back(
      fmt::format("a slower clock repeats each torque in {} rows: taken where it is new", repeats));
}

bool Is(const ColumnSource& source, std::string_view name) { return source.column->name == name; }

/// One joint in a table.
struct JointInTable {
  ReadSettings layout;
  ColumnSource position{}, torque{};
  std::string dead{};                // why its torque cannot be used
  std::vector<std::string> notes{};  // what reading made of its columns
};

/// The layout of one joint.
ReadSettings LayoutOf(const ReadSettings& settings, const ColumnTexts& map, JointKind kind) {
  ReadSettings own = settings;
  own.map = map;
  own.joint = kind;
  // a unit of angles is none of a slide's
  if (kind == JointKind::linear) own.unit.erase("position");
  return own;
}

/// Finds a joint's columns; those of the time, which are the table's, go to `clock`.
JointInTable FindJoint(const RawColumns& table, const FileContent& content, const std::string& name,
                       ReadSettings layout, std::vector<ColumnSource>& clock) {
  JointInTable joint{std::move(layout)};
  RawColumns own{table.file, FindColumns(content.columns, joint.layout, {table.file})};
  own.line = content.line;
  NoteUnits(joint.layout, own);
  joint.notes = std::move(own.notes);
  clock.clear();
  for (ColumnSource& one : own.columns) {
    const FileColumn& column = content.columns[one.index];
    if (Is(one, "time")) clock.push_back(one);
    one.label =
        fmt::format("{} of {} ('{}')", one.column->name, Excerpt(name), Excerpt(column.name));
    if (Is(one, "position")) joint.position = one;
    if (!Is(one, "torque")) continue;
    joint.torque = one;
    joint.dead = column.refusal;
  }
  return joint;
}

/// A column of the table with the table's clock.
RawColumns WithClockOf(const RawColumns& table, ColumnSource column) {
  return {table.file, {table.columns.front(), std::move(column)}, table.line};
}

/// The joint that moves most, as numbers stand in the file: by it the unit of time is checked.
std::size_t WidestOf(const std::vector<JointInTable>& joints) {
  const auto travel = [](const JointInTable& joint) {
    double lower = INFINITY, upper = -INFINITY;
    for (const double x : joint.position.values) {
      if (std::isfinite(x)) lower = std::min(lower, x), upper = std::max(upper, x);
    }
    return upper - lower;
  };
  return static_cast<std::size_t>(std::ranges::max_element(joints, {}, travel) - joints.begin());
}

/// Puts values into the sources of time and of all joints, and the time on one clock.
std::optional<AssumedUnit> TakeTable(FileContent content, const ReadSettings& settings,
                                     RawColumns& table, std::vector<JointInTable>& joints) {
  for (const JointInTable& joint : joints) table.columns.push_back(joint.position);
  for (const JointInTable& joint : joints) {
    if (joint.dead.empty()) table.columns.push_back(joint.torque);
  }
  TakeValues(content, table.file, table.columns);
  table.line = std::move(content.line);
  table.notes = std::move(content.notes);
  const auto assumed = TakeClock(settings, table);
  // back to their joints, without the rows that are not on the clock
  auto next = table.columns.begin() + 1;
  for (JointInTable& joint : joints) joint.position = std::move(*next++);
  for (JointInTable& joint : joints) {
    if (joint.dead.empty()) joint.torque = std::move(*next++);
  }
  table.columns.resize(1, table.columns.front());
  return assumed;
}

/// Notes of the table, then those of joints, each once: with their names where it is not of all.
std::vector<std::string> NotesOf(const std::vector<std::string>& of_table,
                                 const std::vector<JointInTable>& joints,
                                 const std::vector<std::string>& names) {
  std::vector<std::string> notes = of_table;
  std::vector<std::pair<std::string, std::vector<std::string>>> of_joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    for (const std::string& note : joints[j].notes) {
      auto found = std::ranges::find(of_joints, note, &decltype(of_joints)::value_type::first);
      if (found == of_joints.end()) found = of_joints.insert(found, {note, {}});
      if (found->second.empty() || found->second.back() != names[j])
        found->second.push_back(names[j]);
    }
  }
  for (const auto& [note, whose] : of_joints) {
    const bool is_of_all = whose.size() == joints.size();
    notes.push_back(is_of_all ? note : fmt::format("{}: {}", ExcerptOfList(whose), note));
  }
  return notes;
}

}  // namespace

FileContent ReadRobotTable(const RobotLogSource& source, const ReadSettings& settings,
                           const FindLogColumns& find) {
  if (source.columns) return *source.columns;
  const auto wanted = [&](const FileContent& content, const Place& header, const std::string&) {
    std::vector<WantedColumn> all;
    for (const ColumnTexts& map : find(content, header).maps) {
      ReadSettings layout = settings;
      layout.map = map;
      for (const WantedColumn& one : FindMappedColumns(content.columns, layout, header)) {
        const bool is_new = std::ranges::find(all, one.index, &WantedColumn::index) == all.end();
        if (is_new) all.push_back(one);
      }
    }
    return all;
  };
  if (source.text) return ParseColumns(*source.text, source.name, settings, wanted);
  return ReadColumns(source.name, settings, wanted);
}

RobotLog ReadRobotLog(const std::string& source, FileContent content, const ReadSettings& settings,
                      const RobotColumns& columns, const std::vector<JointKind>& kinds) {
  // the table, and its joints in it
  RawColumns table{source, {}};
  std::vector<JointInTable> joints;
  for (std::size_t j = 0; j < columns.maps.size(); ++j) {
    joints.push_back(FindJoint(table, content, columns.joints[j],
                               LayoutOf(settings, columns.maps[j], kinds[j]), table.columns));
  }
  const auto assumed = TakeTable(std::move(content), settings, table, joints);
  const std::size_t widest = WidestOf(joints);

  // each column by itself
  RobotLog log;
  log.source = source;
  std::vector<Measurements> motions, torques;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    JointInTable& joint = joints[j];
    motions.push_back(AssembleOnClock(WithClockOf(table, std::move(joint.position)),
                                      j == widest ? assumed : std::nullopt, joint.layout));
    std::ranges::move(motions.back().notes, std::back_inserter(joint.notes));
    torques.emplace_back();
    try {
      if (joint.dead.empty()) {
        torques.back() =
            AssembleOnClock(WithClockOf(table, std::move(joint.torque)), {}, joint.layout);
        TakeNewValues(torques.back(), joint.notes);
      }
    } catch (const BadInput& refusal) {
      joint.dead = refusal.what();
    }
    std::ranges::move(torques.back().notes, std::back_inserter(joint.notes));
    log.dead.push_back(joint.dead);
  }
  log.notes = NotesOf(table.notes, joints, columns.joints);

  // one clock, even in time, as long as all positions are there
  double begin = -INFINITY, end = INFINITY;
  for (const Measurements& one : motions) {
    begin = std::max(begin, one.time[0]);
    end = std::min(end, one.time[one.size() - 1]);
  }
  log.step = MedianStep(motions.front().time);
  if (!(end - begin > 10 * log.step)) {
    Refuse({log.source}, "its joints have no time in common that would hold 10 samples");
  }
  const Index n = std::ssize(motions);
  const auto samples = static_cast<Index>(std::floor((end - begin) / log.step * (1 + 1e-12))) + 1;
  log.time =
      begin + Eigen::ArrayXd::LinSpaced(samples, 0, static_cast<double>(samples - 1)) * log.step;
  log.position.resize(samples, n);
  log.torque.setZero(samples, n);
  log.logged.setConstant(samples, n, false);
  Eigen::Array<bool, Eigen::Dynamic, 1> moves_logged =
      Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(samples, true);
  for (Index j = 0; j < n; ++j) {
    const Measurements &motion = motions[static_cast<std::size_t>(j)],
                       &torque = torques[static_cast<std::size_t>(j)];
    log.position.col(j) = Interpolated(motion.time, motion.position, log.time);
    moves_logged = moves_logged && OutsideGaps(motion.time, log.time);
    if (torque.size() == 0) continue;
    log.torque.col(j) = Interpolated(torque.time, torque.torque, log.time);
    log.torque_unit = torque.torque_unit;
  }
  // what moves a joint follows from the positions of all, and its torque is its own
  for (Index j = 0; j < n; ++j) {
    const Measurements& torque = torques[static_cast<std::size_t>(j)];
    if (torque.size() > 0) log.logged.col(j) = moves_logged && OutsideGaps(torque.time, log.time);
  }
  return log;
}

}  // namespace warmjoint

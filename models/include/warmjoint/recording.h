// The recording of one joint: how its file is read, and its samples.
//
//   ReadSettings settings;
//   settings.map["torque"] = "force_N";
//   settings.unit["position"] = "deg";
//   for (const Measurements& recording : ReadRecordings({{"monday.csv", "tuesday.csv"}, settings})) {
//     std::printf("%td samples\n", recording.size());
//   }
#pragma once

#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace warmjoint {

/// Samples first, ..., first + count - 1 of a log.
struct SampleRange {
  Eigen::Index first = 0, count = 0;

  Eigen::Index end() const { return first + count; }
};

/// A time without samples.
struct LogGap {
  Eigen::Index behind = 0;  // first sample after it
  double length = 0;        // s
};

/// Most samples of a recording, read or simulated: 14 h at 1 kHz, and some 15 GB while it is identified.
inline constexpr Eigen::Index kMostSamples = 50'000'000;

/// The log of one joint: N samples in order of time. SI (rad or m, s) whatever the file had.
struct Measurements {
  JointKind joint = JointKind::rotary;
  std::string torque_unit = "N.m";  // "N" for linear joints; "A" where a current was logged
  double gear = 1;                  // motor position = gear * joint position
  std::string source;               // file that it came from, for messages
  std::vector<std::string> notes;   // what reading made of it: one phrase each, for people

  Eigen::VectorXd time;                           // [N] s, strictly increasing
  Eigen::VectorXd position;                       // [N] rad or m
  Eigen::VectorXd velocity;                       // [N] rad/s or m/s
  Eigen::VectorXd torque;                         // [N] torque_unit
  std::optional<Eigen::VectorXd> motor_position;  // [N] rad
  std::optional<Eigen::VectorXd> load;            // [N] N.m or N
  std::optional<Eigen::VectorXd> temperature;     // [N] degC
  /// Columns of the file that hold the positions of other joints by their names, as q1 beside q3.
  std::vector<std::string> other_joints;
  /// Whether the positions are the integral of the velocity from 0, in a log that has none.
  bool position_integrated = false;
  /// Where a unit may be another one than it was taken for: one sentence each, which notes hold, too. Warnings of an estimate.
  std::vector<std::string> doubts{};

  Eigen::Index size() const { return time.size(); }
};

/// A run of samples at one constant speed.
struct Segment {
  Eigen::Index begin = 0;  // first sample
  Eigen::Index end = 0;    // one past the last
  double velocity = 0;     // mean, rad/s or m/s; 0 at rest
};

/// Samples that take part in fits. The thermal filter always runs over all samples: those left out
/// still warm the joint (W of a rest is 0, W of an acceleration is not).
struct Selection {
  Eigen::Array<bool, Eigen::Dynamic, 1> keep;  // [N]
  std::vector<Segment> segments;               // moving segments, in order of time

  Eigen::Index count() const { return keep.count(); }
};

/// What is said of single columns of ours, by their names: texts, or finite numbers. A map in YAML, where a column without a
/// text has an empty one; in JSON a list of "column=text".
template <typename T>
struct OfColumns : std::map<std::string, T> {
  using std::map<std::string, T>::map;
  /// What a text says of a column; false where it cannot.
  bool Take(const std::string& column, const std::string& text);
  /// "column=text" each.
  std::vector<std::string> Pairs() const;
};
using ColumnTexts = OfColumns<std::string>;
using ColumnNumbers = OfColumns<double>;

/// How the columns of a file become ours. Names and units as the options of `warmjoint identify` take them.
struct ReadSettings {
  ColumnTexts
      map;  // ours -> theirs, as torque -> force_N (--map); an empty name leaves a column out
  ColumnTexts unit;     // ours -> unit in the file, as position -> deg (--unit)
  ColumnNumbers scale;  // ours -> factor on the values of the file, as torque -> -1 (--scale)
  /// Names of all columns of a text file, in their order, in place of a header (--columns); a name may be empty.
  std::vector<std::string> columns{};
  double rate = 0;  // Hz; makes the time of a file without one (--rate); 0: none
  /// Range after which a position sensor starts again, in the unit of the file (--wrap); 0: a turn.
  double wrap = 0;
  JointKind joint = JointKind::rotary;
  double gear = 1;  // motor turns for each joint turn (rotary), rad of motor per m (linear)
  double torque_constant = 0;  // N.m/A or N/A at the joint: makes torque of a current; 0: none

  template <class A>
  void Serialize(A* a) {
    a->Field("map", &map, {.meaning = "--map, column=name"});
    a->Field("unit", &unit, {.meaning = "--unit, column=unit"});
    a->Field("joint", &joint, {.meaning = "--joint"});
    a->Field("gear", &gear, {.meaning = "--gear"});
    a->Field("scale", &scale, LeftOut("--scale, column=factor"));
    a->Field("columns", &columns, LeftOut("--columns"));
    a->Field("rate", &rate, LeftOut("--rate"));
    a->Field("wrap", &wrap, LeftOut("--wrap"));
    a->Field("torque_constant", &torque_constant, LeftOut("--torque-constant"));
  }
};

/// Throws BadInput for a number that cannot be meant: a gear of 0, a range or a rate below 0, what is not finite.
void CheckReadSettings(const ReadSettings& settings);

/// What a user asks of the segments that are kept.
struct PrepareSettings {
  double trim = 0;           // s to leave out at each end of a segment
  double shortest_hold = 0;  // s; segments that last less, before they are trimmed, are left out

  template <class A>
  void Serialize(A* a) {
    constexpr FieldInfo seconds{
        .unit = "s", .bounds = {.at_least = 0}, .at_default = AtDefault::left_out};
    a->Field("trim", &trim, seconds);
    a->Field("shortest_hold", &shortest_hold, seconds);
  }
};

/// What a project file says; what it leaves out is empty.
struct Project {
  ColumnTexts map, unit;
  ColumnNumbers scale;
  std::vector<std::string> columns{};
  std::optional<JointKind> joint;
  std::optional<double> rate, gear, wrap, trim, shortest_hold;

  template <class A>
  void Serialize(A* a) {
    constexpr FieldInfo left_out{.at_default = AtDefault::left_out};
    a->Field("map", &map, left_out);
    a->Field("unit", &unit, left_out);
    a->Field("scale", &scale, left_out);
    a->Field("columns", &columns, left_out);
    a->Field("rate", &rate, {.unit = "Hz", .bounds = {.above = 0}});
    a->Field("joint", &joint);
    a->Field("gear", &gear);
    a->Check(!gear || *gear != 0, "gear", "a number other than 0");
    a->Field("wrap", &wrap, {.bounds = {.above = 0}});
    a->Field("trim", &trim, {.unit = "s", .bounds = {.at_least = 0}});
    a->Field("shortest_hold", &shortest_hold, {.unit = "s", .bounds = {.at_least = 0}});
  }
};

/// What was taken of a project file.
struct TakenProject {
  std::string file;
  Project values;

  template <class A>
  void Serialize(A* a) {
    a->Field("file", &file, {.meaning = "the project file", .needed = "name it"});
    a->Field("values", &values, {.meaning = "what was taken of it", .needed = "give what it set"});
  }
};

/// The files of a recording, and how they are read: the `recording` member of an estimate file, by which its pictures find
/// the data again.
struct RecordingSource {
  std::vector<std::string> files{};
  ReadSettings read{};
  PrepareSettings prepare{};
  std::optional<TakenProject> project{};  // whose values stand above; a member `project` of its own

  template <class A>
  void Serialize(A* a) {
    a->Field("files", &files,
             {.meaning = "as seen from the folder of this file", .needed = "give --recording"});
    read.Serialize(a);
    prepare.Serialize(a);
  }
};

/// Reads the recordings: CSV, HDF5 (.h5, .hdf5) or MATLAB (.mat).
/// Libraries for HDF5 and MATLAB work in a child process with limits on memory and time, since they crash on some damaged
/// files: for one thread at a time, best before others start. Throws BadInput.
std::vector<Measurements> ReadRecordings(const RecordingSource& source);

/// Makes a recording of vectors, with the conversions and checks of a file. columns: values by the names that a file would
/// have in its header, all of one length. name: of the recording in messages. Throws BadInput.
///   MakeRecording({{"time", t}, {"position", q}, {"current", i}},
///                 {.map = {{"torque", "current"}}, .unit = {{"torque", "A"}}})
Measurements MakeRecording(const std::map<std::string, std::vector<double>>& columns,
                           const ReadSettings& settings = {},
                           const std::string& name = "recording");

/// Writes .h5 and .hdf5 as HDF5, .csv as CSV: SI, numbers that read back bit for bit. Throws BadInput for other names, and
/// OutputFailed; nothing half-written stays.
void WriteRecording(const Measurements& measurements, const std::filesystem::path& file);

}  // namespace warmjoint

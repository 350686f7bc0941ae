// The recording of one joint, its preparation and its check; with the version and the errors of the whole interface.
//
//   using namespace warmjoint::api;
//   ReadSettings settings;
//   settings.map["torque"] = "force_N";
//   settings.unit["position"] = "deg";
//   const Recording recording = ReadRecording("log.csv", settings);
//   std::puts(Check(recording).text.c_str());
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#define WARMJOINT_VERSION_MAJOR 0
#define WARMJOINT_VERSION_MINOR 1
#define WARMJOINT_VERSION_PATCH 0

namespace warmjoint::api {

/// Version of the library that is linked, "0.1.0"; the macros above are those of the headers.
std::string Version();

/// What was given cannot be used. what() is one sentence with the place (file:line, or the option as the command line
/// calls it: `--relevance` is the member `relevance` of the settings), the value, the bound and the remedy.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What was made cannot be kept: a full disk, a failing device. what() says which file and why.
class OutputFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Rotary joints have rad and N.m, linear ones m and N.
enum class JointKind { rotary, linear };

/// How the columns of a file, or of vectors, become ours: time, position, velocity, torque, and optional motor_position,
/// load, temperature. Names and units as `warmjoint identify --map --unit --scale --wrap --joint --gear` takes them.
struct ReadSettings {
  std::map<std::string, std::string> map{};  // ours -> theirs: {"torque", "force_N"}
  std::map<std::string, std::string>
      unit{};                             // ours -> unit: {"position", "deg"}; SI where not given
  std::map<std::string, double> scale{};  // ours -> factor: {"torque", -1}
  double wrap = 0;                        // range of the position sensor, in its unit; 0: a turn
  JointKind joint = JointKind::rotary;
  double gear = 1;  // motor turns for each joint turn (rotary), rad of motor per m (linear)
  double torque_constant = 0;  // N.m/A or N/A at the joint: makes torque of a current; 0: none
};

/// What is asked of the constant speeds that fits use.
struct PrepareSettings {
  double trim = 0;           // s to leave out at each end of a constant speed, at least 0
  double shortest_hold = 0;  // s; a constant speed that lasts less is left out, at least 0
};

/// The files that a recording was read from, and how.
struct Origin {
  std::vector<std::string> files;
  ReadSettings read{};
  PrepareSettings prepare{};
  /// The project file that set some of these, and what it set, as in estimate.json; both empty without one.
  std::string project_file{}, project{};
};

/// The log of one joint: N samples in order of time, SI.
struct Recording {
  JointKind joint = JointKind::rotary;
  std::string torque_unit = "N.m";   // "N" for linear joints; "A" where a current was logged
  double gear = 1;                   // motor position = gear * joint position
  std::string source{};              // its name in messages
  std::vector<std::string> notes{};  // what reading made of it, for people

  std::vector<double> time{};      // [N] s, strictly increasing
  std::vector<double> position{};  // [N] rad or m
  std::vector<double> velocity{};  // [N] rad/s or m/s; empty: the positions tell it
  std::vector<double> torque{};    // [N] torque_unit
  std::optional<std::vector<double>> motor_position{};  // [N] rad
  std::optional<std::vector<double>> load{};            // [N] N.m or N
  std::optional<std::vector<double>> temperature{};     // [N] degC

  /// Of several recordings joined: the first sample of each but the first. The joint is cold there again.
  std::vector<std::size_t> starts{};
  std::optional<Origin> origin{};  // where it was read from; estimates keep it
};

/// Reads a CSV file, or HDF5 where the name ends in .h5 or .hdf5. The HDF5 library works in a child process, since it
/// crashes on some damaged files; HDF5 is for one thread at a time, best before others start. Throws BadInput.
Recording ReadRecording(const std::filesystem::path& file, const ReadSettings& settings = {});

/// Reads several recordings of one joint, each from a cold start, as one. Throws BadInput, also for no file.
Recording ReadRecordings(const std::vector<std::filesystem::path>& files,
                         const ReadSettings& settings = {});

/// Makes a recording of vectors, with the conversions and checks of a file. columns: values by the names that a file would
/// have in its header, all of one length. name: of the recording in messages. Throws BadInput.
///   MakeRecording({{"time", t}, {"position", q}, {"velocity", v}, {"current", i}}, {.map = {{"torque", "current"}}})
Recording MakeRecording(const std::map<std::string, std::vector<double>>& columns,
                        const ReadSettings& settings = {}, const std::string& name = "recording");

/// Writes CSV, or HDF5 where the name ends in .h5 or .hdf5: SI, numbers that read back bit for bit. Throws BadInput and
/// OutputFailed; nothing half-written stays.
void WriteRecording(const Recording& recording, const std::filesystem::path& file);

/// A stretch of constant speed that fits use.
struct Segment {
  int recording = 1;        // of several joined, from 1
  double begin = 0;         // s, time of its first sample
  double end = 0;           // s, time of its last
  double velocity = 0;      // rad/s or m/s, its mean
  std::size_t samples = 0;  // that take part
};

/// A recording prepared for a fit: constant speeds found, a velocity told by the positions where the log has none, switches
/// of speed split, faults searched. Identifiers take nothing else. A recording converts into it, prepared by default
/// settings. Cheap to copy, safe to read from many threads.
///   const PreparedLog log(recording, {.trim = 0.5});
class PreparedLog {
 public:
  /// Throws BadInput for columns of unlike length, values that are not finite, time that does not increase, fewer than three
  /// samples, a torque that never changes, and settings out of their bounds.
  PreparedLog(const Recording& recording,
              const PrepareSettings& settings = {});  // NOLINT: converts

  /// The constant speeds, in order of time.
  std::vector<Segment> segments() const;
  /// What in the log contradicts itself, each one sentence; with any of them, identifying ends as bad_data.
  const std::vector<std::string>& faults() const;
  /// What a reader of the numbers must know of what was done, each one sentence.
  const std::vector<std::string>& warnings() const;
  JointKind joint() const;

  struct State;  // of the implementation
  const State& state() const { return *state_; }

 private:
  std::shared_ptr<const State> state_;
};

/// How the samples lie in time.
struct SamplingCheck {
  std::size_t samples = 0;
  double duration = 0;  // s
  double step = 0;      // s, median
  double rate = 0;      // Hz, 1 / step
  double jitter = 0;    // standard deviation of the steps, gaps left out, as a share of the median
  int gaps = 0;
  double longest_gap = 0;  // s
};

/// Segments at (almost) one speed.
struct SpeedLevel {
  double velocity = 0;  // rad/s or m/s, signed
  int segments = 0;
  std::size_t samples = 0;
};

/// How the joint moves.
struct MotionCheck {
  double constant_share = 0;  // of the samples, at a constant speed
  double rest_share = 0;      // of the samples, at rest
  int segments = 0;
  std::vector<SpeedLevel> levels{};  // in order of velocity
  double lower = 0, upper = 0;       // rad or m, travel
  double speed_noise = 0;            // rad/s or m/s, around constant speeds
  double speed_resolution = 0;       // rad/s or m/s; 0: not quantised
};

/// Whether one thing can be identified, and why (not).
struct Excitation {
  std::string what;  // "law asymmetric", "warm-up", ...
  bool sufficient = false;
  std::string reason{};  // one sentence; where insufficient it ends in the remedy
};

/// What a recording holds and what can be identified from it.
struct RecordingCheck {
  SamplingCheck sampling{};
  MotionCheck motion{};
  std::vector<std::string> faults{};
  std::vector<Excitation> excitation{};
  std::string text{};  // as `warmjoint check` prints it
  std::string json{};  // as `warmjoint check --format json` prints it
};

/// Looks at a recording; joined ones are looked at as one.
RecordingCheck Check(const PreparedLog& log);

}  // namespace warmjoint::api

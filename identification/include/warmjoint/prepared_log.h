// A recording as every identifier gets it, and its check.
//
//   const PreparedLog log = Prepare(ReadRecordings({{"log.csv"}}), {.trim = 0.5});
//   std::puts(CheckToText(CheckRecording(log)).c_str());
#pragma once

#include <warmjoint/recording.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace warmjoint {

/// A log in the form that fits use: the samples of one recording, or of several of one joint one after the other, with what
/// preparation found in addition to what was logged.
struct LogSamples : Measurements {
  LogSamples() = default;
  /// Those of one recording, as it was logged.
  explicit LogSamples(Measurements recording) : Measurements(std::move(recording)) {}

  std::optional<Eigen::VectorXd> acceleration;  // [N] rad/s^2 or m/s^2, for fits to any motion
  /// [N] rad/s or m/s, the same: mean of |v| until the next sample, and mean of v^2 over that, with
  /// the sign of v, at which a straight line of force over speed has its mean loss.
  std::optional<Eigen::VectorXd> mean_speed;
  std::optional<Eigen::VectorXd> loss_velocity;

  /// First samples of all recordings but the first. The joint is cold there again, or as warm as an
  /// estimate has it.
  std::vector<Eigen::Index> further_starts;

  /// Where rows are means of several samples, their times no longer show the gaps: then these are the gaps between the
  /// samples, each with the row that begins after it. Otherwise nothing, and gaps are found by the time.
  std::optional<std::vector<LogGap>> gaps;

  /// Samples that were not logged but put in, ascending (InsertSamples).
  std::vector<Eigen::Index> inserted;

  /// The list of recordings: the places of the samples of each. [R >= 1]
  std::vector<SampleRange> Recordings() const;

  /// The samples that were logged, ascending.
  std::vector<Eigen::Index> Logged() const;
};

/// A log and the samples of it that take part in fits.
struct LogView {
  LogSamples measurements;
  Selection selection;
};

/// From what a velocity comes: a column that was logged, or its positions alone.
enum class MotionSource { velocity, positions };

/// The effect of noise of the velocity on a slope over |v|.
struct VelocityNoise {
  double noise = 0;        // of the velocity within segments, rad/s or m/s
  double attenuation = 0;  // share of a slope over |v| that this noise would hide
  double left = 0;         // the share that the noise of one velocity for a segment still hides
  double mean_speed = 0;   // mean |v| of the kept samples, rad/s or m/s
  double error = 0;        // of the one velocity for a segment, rms over the samples, rad/s or m/s
  double spread = 0;       // variance of the segments' |v|, (rad/s)^2 or (m/s)^2

  /// Both shares, by the errors and the spread.
  void FindShares() {
    attenuation = noise * noise / (noise * noise + spread);
    left = error * error / (error * error + spread);
  }
};

/// A contradiction within a log (log_faults.h).
struct LogFault {
  std::string sentence;
  bool is_absurd_torque = false;  // of samples that WithoutAbsurd leaves out
};

/// Recordings of one joint, prepared for a fit: the samples of constant speed, one velocity for each
/// segment where the noise of the samples' would bias a fit (segment_velocity.h), the speed between
/// segments, with samples put in where it changes between two (transitions.h), and the faults of the
/// log. Where a recording has no velocity, it follows from its positions (motion_from_positions.h).
/// Only Prepare and Join make one, and identifiers take nothing else, so that no step can be
/// forgotten. Several recordings follow one after the other, with one step of time between them. Cheap to copy: copies
/// share the samples.
class PreparedLog {
 public:
  /// The log as it was taken: for fits that follow changes of speed from sample to sample. A
  /// velocity that it lacks is the smoothed slope of its positions (DeriveVelocity).
  const LogView& raw() const { return log_->raw; }

  /// The log for fits at constant speed.
  const LogView& constant_speed() const {
    return log_->constant_speed ? *log_->constant_speed : log_->raw;
  }

  /// What the velocity of `raw` was taken from; of several recordings, positions where one has no other.
  MotionSource source() const { return log_->source; }

  /// The log for fits to motion of any kind (moving_view.h). Made when it is first asked for, by
  /// whichever thread is first.
  const LogView& moving() const;
  /// What a reader of a fit to `moving` must know of the changes to its velocity, each one sentence.
  const std::vector<std::string>& moving_warnings() const;

  /// Whether the log shows friction mainly at constant speeds (moving_view.h).
  bool holds_speeds() const { return log_->holds_speeds; }

  /// The noise of a velocity that was averaged over segments, if it was.
  const std::optional<VelocityNoise>& velocity_noise() const { return log_->velocity_noise; }

  /// The largest share of the path that a drive which takes time to reverse would not
  /// have travelled: ramps through 0 that no sample shows.
  double unresolved_path() const { return log_->unresolved_path; }

  /// The contradictions within the log, each one sentence (log_faults.h).
  std::vector<std::string> faults() const;

  /// What a reader of the numbers must know of the preparation, each one sentence.
  const std::vector<std::string>& warnings() const { return log_->warnings; }

  /// What WithoutAbsurd left out, one sentence.
  const std::optional<std::string>& absurd() const { return log_->absurd; }

  /// The samples before a time (s), with all that was done to them.
  PreparedLog Before(double time) const;

  /// The log without samples of absurd torque (log_faults.h), which is no fault any more. For a loss
  /// that bounds the pull of a sample.
  const PreparedLog& WithoutAbsurd() const {
    return log_->without_absurd ? *log_->without_absurd : *this;
  }

 private:
  struct Log {
    LogView raw;
    MotionSource source = MotionSource::velocity;  // of its velocity
    std::optional<LogView> constant_speed{};       // where anything was done to the log
    std::optional<VelocityNoise> velocity_noise{};
    double unresolved_path = 0;
    std::vector<LogFault> faults{};
    std::vector<std::string> warnings{};
    std::vector<Eigen::Index> left_out{};  // of the samples that were logged
    std::optional<std::string> absurd{};
    std::vector<PreparedLog> recordings{};  // of several, in their order
    // what the constructor finds
    bool holds_speeds = false;
    std::shared_ptr<const PreparedLog> without_absurd{};  // none where no sample is absurd
  };

  /// The view `moving`, once it is made.
  struct Moving {
    std::once_flag once;
    LogView view;
    std::vector<std::string> warnings;
  };

  struct Maker;
  explicit PreparedLog(Log log);
  void MakeMoving(Moving& made) const;
  static std::shared_ptr<const PreparedLog> LeaveOutAbsurd(const Log& log);
  friend PreparedLog Prepare(Measurements measurements, const PrepareSettings& holds);
  friend PreparedLog Prepare(Measurements measurements, Selection known);
  friend PreparedLog Join(std::vector<PreparedLog> recordings);

  std::shared_ptr<const Log> log_;
  std::shared_ptr<Moving> moving_ = std::make_shared<Moving>();
};

/// Prepares a recording: the samples at constant speed are found in it (select.h). Command line, suites,
/// tests of verdicts and benchmarks all use it. Throws BadInput where there is no velocity
/// and the slope of the positions is no number.
PreparedLog Prepare(Measurements measurements, const PrepareSettings& holds = {});

/// Several recordings of one joint, each prepared by itself. Throws BadInput as Join does.
PreparedLog Prepare(std::vector<Measurements> recordings, const PrepareSettings& holds = {});

/// The same where a plant says which samples are at constant speed.
PreparedLog Prepare(Measurements measurements, Selection known);

/// Recordings of one joint as one log, one after the other (LogSamples::Recordings). A column that
/// one of them lacks is left out, and noted. One recording comes back as it is. Throws BadInput where
/// none is given, or where units, kinds of joint or gears differ.
PreparedLog Join(std::vector<PreparedLog> recordings);

/// A kind of friction that a motion may show or not.
enum class FrictionKind {
  coulomb,
  viscous_coulomb,
  asymmetric,
  stribeck,
  warm_up,
  position_ripple,
  motor_ripple,
};

/// How the samples lie in time.
struct SamplingCheck {
  Eigen::Index samples = 0;
  double duration = 0;     // s
  double step = 0;         // s, median
  double rate = 0;         // Hz, 1 / step
  double jitter = 0;       // standard deviation of the steps (gaps left out), share of the median
  int gaps = 0;            // GapsOf
  double longest_gap = 0;  // s
};

/// Segments at (almost) one speed.
struct SpeedLevel {
  double velocity = 0;  // rad/s or m/s, signed; mean over the segments' samples
  int segments = 0;
  Eigen::Index samples = 0;
};

/// How the joint moves.
struct MotionCheck {
  double constant_share = 0;  // share of the samples at a constant speed
  double rest_share = 0;      // share of the samples at rest
  int segments = 0;
  std::vector<SpeedLevel> levels;  // in order of velocity, 5 % wide
  double lower = 0, upper = 0;     // rad or m, travel
  double speed_noise = 0;          // rad/s or m/s, around constant speeds
  double speed_resolution = 0;     // rad/s or m/s; 0: not quantised
  double position_resolution =
      0;  // rad or m, of positions from which the velocity is taken; 0: not quantised
  bool holds_speeds = false;  // else fits take motion of any kind
  Eigen::Index fitted = 0;    // samples that fits take
};

/// Whether friction of one kind can be identified, and why (not).
struct Excitation {
  FrictionKind kind = FrictionKind::coulomb;
  std::string what;  // the kind in words: "law asymmetric", ...
  bool sufficient = false;
  std::string reason;  // one sentence; where insufficient, it ends in the remedy
};

struct RecordingCheck {
  std::string source;
  JointKind joint = JointKind::rotary;
  std::string torque_unit;
  std::vector<std::string> notes;  // what reading made of it
  SamplingCheck sampling;
  MotionCheck motion;
  std::vector<std::string> faults;  // log_faults.h
  std::vector<Excitation> excitation;
};

/// Looks at a recording.
RecordingCheck CheckRecording(const PreparedLog& log);

/// The same of a recording that is not yet prepared.
RecordingCheck CheckRecording(const Measurements& measurements);

/// Lines for people: sampling, motion, speeds in each direction, faults, and what can be identified.
std::string CheckToText(const RecordingCheck& check);

}  // namespace warmjoint

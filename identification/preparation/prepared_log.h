// A log as every identifier gets it.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "identification/preparation/log_view.h"

namespace warmjoint::inline identification {

struct PrepareSettings;

/// What is made when it is first asked for, by whichever thread is first.
template <typename T>
class MadeOnce {
 public:
  const T& Get(const std::function<T()>& make) {
    std::call_once(once_, [&] { value_ = make(); });
    return value_;
  }

 private:
  std::once_flag once_;
  T value_{};
};

/// A recording prepared for a fit: what moves at constant speed, one velocity for each segment where
/// the noise of the samples' would bias a fit (segment_velocity.h), a sample at each switch of speed
/// that happens between two samples (split_at_switches.h), the speed between segments from the
/// positions where they tell more of it (take_ways.h), and the faults of the log. Where the log
/// has no velocity, its positions tell it (motion_from_positions.h). Only Prepare
/// (prepare.h) makes one, and identifiers take nothing else, so that nobody can forget a step. Cheap to copy:
/// copies share the samples.
class PreparedLog {
 public:
  /// The log as it was taken: for fits that follow changes of speed from sample to sample. A
  /// velocity that it lacks is the smoothed slope of its positions (derive_velocity.h).
  const LogView& taken() const { return log_->taken; }

  /// The log as fits at constant speed see it.
  const LogView& steady() const { return log_->steady ? *log_->steady : log_->taken; }

  /// What tells the velocity of `taken`.
  MotionSource source() const { return log_->source; }

  /// What others found in the log when they first needed it (moving_view.h).
  struct Found {
    MadeOnce<LogView> moving;
    MadeOnce<bool> holds_speeds;
    MadeOnce<std::shared_ptr<const PreparedLog>>
        without_absurd;  // or none, where no sample is absurd
  };
  Found& found() const { return *found_; }

  /// Leaves those out of a view of the log that were left out of the log itself.
  void LeaveOut(LogView& view) const;

  /// What was done to the velocity, if anything.
  const std::optional<VelocityNoise>& velocity_noise() const { return log_->velocity_noise; }

  /// Share of the path that the log cannot tell from standing still (SplitLog::unseen).
  double unseen() const { return log_->unseen; }

  /// What in the log contradicts itself, each one sentence (log_faults.h).
  const std::vector<std::string>& faults() const { return log_->faults; }

  /// What a reader of the numbers must know of what was done, each one sentence.
  const std::vector<std::string>& warnings() const { return log_->warnings; }

  /// What WithoutAbsurd left out, one sentence.
  const std::optional<std::string>& absurd() const { return log_->absurd; }

  /// The samples before a time (s), with all that was done to them.
  PreparedLog Before(double time) const;

  /// The log without samples of absurd torque (log_faults.h), which is no fault any more; made once. For a
  /// loss that bounds the pull of a sample.
  const PreparedLog& WithoutAbsurd() const;

 private:
  struct Log {
    LogView taken;
    MotionSource source = MotionSource::velocity;  // of its velocity
    std::optional<LogView> steady;                 // where anything was done to the log
    std::optional<VelocityNoise> velocity_noise;
    double unseen = 0;
    std::vector<std::string> faults;
    std::vector<std::string> warnings;
    std::vector<double> left_out{};  // times of samples, s
    std::optional<std::string> absurd{};
  };

  struct Maker;
  explicit PreparedLog(Log log) : log_(std::make_shared<const Log>(std::move(log))) {}
  friend PreparedLog Prepare(Measurements measurements, const PrepareSettings& holds);
  friend PreparedLog Prepare(Measurements measurements, Selection known);

  std::shared_ptr<const Log> log_;
  std::shared_ptr<Found> found_ = std::make_shared<Found>();
};

}  // namespace warmjoint::inline identification

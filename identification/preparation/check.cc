#include "identification/preparation/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "identification/preparation/position_noise.h"
#include "identification/preparation/velocity_scale.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kFewestMoving = 15;  // of a direction; why: fits of motion of any kind take 30

SamplingCheck CheckSampling(const VectorXd& time, double step) {
  const Index n = time.size();
  SamplingCheck check;
  check.samples = n;
  check.duration = time[n - 1] - time[0];
  check.step = step;
  check.rate = 1 / step;

  // steps within the recording show the jitter; longer ones are gaps
  double squares = 0;
  for (Index i = 1; i < n; ++i) {
    const double length = time[i] - time[i - 1], off = length - step;
    if (length > kGapSteps * step) {
      ++check.gaps;
      check.longest_gap = std::max(check.longest_gap, length);
    } else {
      squares += off * off;
    }
  }
  // jitter in steps: root mean square of what a step differs from the median one
  const auto steps = static_cast<double>(std::max<Index>(n - 1 - check.gaps, 1));
  check.jitter = std::sqrt(squares / steps) / step;
  return check;
}

/// Segments in groups of one speed: a group ends where the next speed is 5 % further on.
std::vector<SpeedLevel> Levels(std::vector<Segment> segments) {
  std::ranges::sort(segments, {}, &Segment::velocity);
  std::vector<SpeedLevel> levels;
  double first = 0;  // slowest of the group
  for (const Segment& segment : segments) {
    const Index samples = segment.end - segment.begin;
    // a new level begins where the speed has grown by 5 %
    if (levels.empty() || segment.velocity - first > 0.05 * std::abs(first)) {
      levels.push_back({0, 0, 0});
      first = segment.velocity;
    }
    // the mean speed of the level, weighted by samples
    SpeedLevel& level = levels.back();
    const auto before = static_cast<double>(level.samples), added = static_cast<double>(samples);
    level.velocity = (before * level.velocity + added * segment.velocity) / (before + added);
    level.samples += samples;
    ++level.segments;
  }
  return levels;
}

MotionCheck CheckMotion(const Measurements& measurements, const VelocityScale& scale,
                        const Selection& selection) {
  const auto n = static_cast<double>(measurements.size());
  MotionCheck check;
  // shares of the samples that identification uses, and at rest
  check.constant_share = static_cast<double>(selection.count()) / n;
  const auto resting = (measurements.velocity.array().abs() <= scale.Rest()).count();
  check.rest_share = static_cast<double>(resting) / n;
  check.segments = static_cast<int>(selection.segments.size());
  check.levels = Levels(selection.segments);
  // travel, and the noise and resolution of the velocity
  check.lower = measurements.position.minCoeff();
  check.upper = measurements.position.maxCoeff();
  check.speed_noise = scale.noise;
  check.speed_resolution = scale.resolution;
  return check;
}

/// Speeds in one direction: how many levels, the slowest and the fastest.
struct Direction {
  int levels = 0;
  double slowest = 0, fastest = 0;  // rad/s or m/s, magnitudes
};

constexpr double kAnotherSpeed =
    1.1;  // times; why: a slope over a smaller range is lost in the error of a level

Direction SpeedsWithSign(const MotionCheck& motion, int sign) {
  Direction direction;
  for (const SpeedLevel& level : motion.levels) {
    const double speed = sign * level.velocity;
    if (speed <= 0) continue;
    direction.slowest = direction.levels == 0 ? speed : std::min(direction.slowest, speed);
    direction.fastest = std::max(direction.fastest, speed);
    ++direction.levels;
  }
  return direction;
}

/// The same of motion of any kind: nearly all speeds of the samples that a fit takes, two levels where they differ.
Direction SpeedsWithSign(const LogView& moving, int sign) {
  constexpr double tail = 0.02;  // why: a few samples at a turn or a peak show nothing of a slope
  std::vector<double> speeds;
  for (Index i = 0; i < moving.measurements.size(); ++i) {
    const double speed = sign * moving.measurements.velocity[i];
    if (moving.selection.keep[i] && speed > 0) speeds.push_back(speed);
  }
  std::ranges::sort(speeds);
  if (std::ssize(speeds) < kFewestMoving) return {};
  const double slowest = Quantile(speeds, tail), fastest = Quantile(speeds, 1 - tail);
  return {fastest > kAnotherSpeed * slowest ? 2 : 1, slowest, fastest};
}

/// The data for all judgements.
struct ShownMotion {
  const Measurements& measurements;
  const SamplingCheck& sampling;
  const MotionCheck& motion;
  std::string_view speed_unit, length_unit;
  Direction positive, negative;

  /// Whether there are samples that a fit can take.
  bool moves() const { return positive.levels + negative.levels > 0; }
  double slowest() const {
    if (positive.levels == 0) return negative.slowest;
    if (negative.levels == 0) return positive.slowest;
    return std::min(positive.slowest, negative.slowest);
  }
  double fastest() const { return std::max(positive.fastest, negative.fastest); }
  bool both_directions() const { return positive.levels > 0 && negative.levels > 0; }
};

/// Whether the motion shows a kind of friction, and why.
struct Judged {
  bool sufficient;
  std::string reason;
};

Judged Coulomb(const ShownMotion& e) {
  if (e.moves() && e.motion.holds_speeds) {
    return {true, fmt::format("{} segments at constant speed", e.motion.segments)};
  }
  if (e.moves()) {
    return {true, fmt::format("{} samples that move, with inertia: fewer than half hold a speed",
                              e.motion.fitted)};
  }
  return {false,
          "too few samples move, at a constant speed or between turns; record piecewise constant "
          "speeds, each held for longer than the acceleration between them"};
}

Judged ViscousCoulomb(const ShownMotion& e) {
  if (!e.moves()) return {false, Coulomb(e).reason};
  // slope and level need two speeds
  const double ratio = e.fastest() / e.slowest();
  if (ratio > kAnotherSpeed) {
    return {true,
            fmt::format("speeds from {:.3g} to {:.3g} {}", e.slowest(), e.fastest(), e.speed_unit)};
  }
  return {false,
          fmt::format(
              "all that is fitted moves at about {:.3g} {}, so that viscous and coulomb cannot be "
              "separated; record a second speed, best ten times slower or faster",
              e.fastest(), e.speed_unit)};
}

Judged Asymmetric(const ShownMotion& e) {
  if (!e.moves()) return {false, Coulomb(e).reason};
  // both directions, since their difference is to be determined
  if (!e.both_directions()) {
    return {false, fmt::format("all that is fitted moves in the {} direction; record both",
                               e.positive.levels > 0 ? "positive" : "negative")};
  }
  // three unknowns: a second speed in one direction at least
  if (e.positive.levels < 2 && e.negative.levels < 2) {
    return {false,
            "each direction has one speed, so that the slope and the two levels cannot be "
            "separated; record a second speed"};
  }
  return {true, "several speeds and both directions"};
}

Judged Stribeck(const ShownMotion& e) {
  if (!e.moves()) return {false, Coulomb(e).reason};
  if (!e.motion.holds_speeds) {
    return {false,
            "the curve is fitted to constant speeds, and fewer than half of what moves holds one; "
            "record at least 5, the slowest below 1/20 of the fastest"};
  }
  // the drop near rest shows only in speeds that lie far below the others
  const int levels = std::max(e.positive.levels, e.negative.levels);
  if (levels >= 5 && e.slowest() <= 0.05 * e.fastest()) {
    return {true, fmt::format("{} speeds, the slowest {:.2g} of the fastest", levels,
                              e.slowest() / e.fastest())};
  }
  return {false, fmt::format(
                     "needs at least 5 speeds, the slowest below 1/20 of the fastest; this log has "
                     "{}, the slowest at {:.2g} of the fastest",
                     levels, e.slowest() / e.fastest())};
}

Judged WarmUp(const ShownMotion& e) {
  if (!e.moves()) return {false, Coulomb(e).reason};
  // a log as long as a time constant
  if (e.sampling.duration < kShortestWarming) {
    return {false,
            fmt::format("the log lasts {:.3g} s and joints warm with time constants of minutes; "
                        "record at least {:.0f} s, better 20 min, from a cold start",
                        e.sampling.duration, kShortestWarming)};
  }
  // two speeds: the loss, and with it the heat, must vary
  if (e.fastest() < kAnotherSpeed * e.slowest()) {
    return {false, "one speed alone warms the joint at one rate; record a second speed"};
  }
  return {true, fmt::format(
                    "{:.3g} min: time constants up to about that long; the start must be cold, or "
                    "E(0) estimated",
                    e.sampling.duration / 60)};
}

Judged Ripple(const ShownMotion& e) {
  if (!e.moves()) return {false, Coulomb(e).reason};
  if (e.measurements.position_integrated) return {false, "the log has no positions; log them"};
  // shortest period seen at the fastest speed: four samples on each
  const double finest = 4 * e.fastest() * e.sampling.step;
  const double travel = e.motion.upper - e.motion.lower;
  if (travel < 4 * finest) {
    return {false,
            fmt::format("the joint travels {:.3g} {}, {:.2g} of them between samples; record a "
                        "longer travel or a higher rate",
                        travel, e.length_unit, finest / 4)};
  }
  return {true, fmt::format("over {:.3g} {}; ripple with a period above {:.2g} {}", travel,
                            e.length_unit, finest, e.length_unit)};
}

Judged MotorRipple(const ShownMotion& e) {
  const double gear = std::abs(e.measurements.gear);
  if (!KnowsMotorAngle(e.measurements)) {
    return {false, e.measurements.position_integrated
                       ? "the log has no positions; log them"
                       : "the gear is not known; give --gear or a column motor_position"};
  }
  const double turns =
      (e.motion.upper - e.motion.lower) * gear / (2 * std::numbers::pi);  // of the motor
  // the log must show a whole turn, and each turn four samples
  const double per_turn = 2 * std::numbers::pi / (gear * e.fastest() * e.sampling.step);
  if (!e.moves()) return {false, Coulomb(e).reason};
  if (turns < 1 || per_turn < 4) {
    return {false,
            fmt::format("the motor turns {:.3g} times with {:.2g} samples a turn at the fastest "
                        "speed; record at least one turn and four samples a turn",
                        turns, per_turn)};
  }
  return {true, fmt::format("{:.3g} motor turns, at least {:.3g} samples a turn", turns, per_turn)};
}

struct Kind {
  FrictionKind kind;
  const char* what;
  Judged (*judge)(const ShownMotion&);
};

constexpr Kind kKinds[] = {
    {FrictionKind::coulomb, "law coulomb", &Coulomb},
    {FrictionKind::viscous_coulomb, "law viscous_coulomb", &ViscousCoulomb},
    {FrictionKind::asymmetric, "law asymmetric", &Asymmetric},
    {FrictionKind::stribeck, "law stribeck", &Stribeck},
    {FrictionKind::warm_up, "warm-up (thermal_gain, thermal_time_constant)", &WarmUp},
    {FrictionKind::position_ripple, "position dependence", &Ripple},
    {FrictionKind::motor_ripple, "motor ripple", &MotorRipple},
};

/// What the motion shows of each kind of friction.
std::vector<Excitation> JudgeExcitation(const PreparedLog& log, const SamplingCheck& sampling,
                                        const MotionCheck& motion) {
  const Measurements& measurements = log.raw().measurements;
  const auto speeds = [&](int sign) {
    return motion.holds_speeds ? SpeedsWithSign(motion, sign) : SpeedsWithSign(log.moving(), sign);
  };
  const ShownMotion evidence{measurements,
                             sampling,
                             motion,
                             kVelocityUnit.For(measurements.joint),
                             kPositionUnit.For(measurements.joint),
                             speeds(1),
                             speeds(-1)};
  // each kind of friction by a rule of its own
  std::vector<Excitation> all;
  for (const Kind& one : kKinds) {
    Judged judged = one.judge(evidence);
    all.push_back({one.kind, one.what, judged.sufficient, std::move(judged.reason)});
  }
  return all;
}

}  // namespace

RecordingCheck CheckRecording(const PreparedLog& log) {
  const auto& [measurements, selection] = log.raw();
  const VelocityScale scale = MeasureVelocity(measurements);
  RecordingCheck check;
  // what was read
  check.source = measurements.source;
  check.joint = measurements.joint;
  check.torque_unit = measurements.torque_unit;
  check.notes = measurements.notes;
  // what was measured, and what can be identified from it
  check.sampling = CheckSampling(measurements.time, scale.step);
  check.motion = CheckMotion(measurements, scale, selection);
  if (log.source() == MotionSource::positions) {
    check.motion.position_resolution = MeasurePositionNoise(measurements.position).resolution;
  }
  check.faults = log.faults();
  // the samples that fits take
  check.motion.holds_speeds = log.holds_speeds();
  check.motion.fitted =
      (check.motion.holds_speeds ? log.constant_speed() : log.moving()).selection.count();
  if (!check.motion.holds_speeds) {
    check.notes.insert(check.notes.end(), log.moving_warnings().begin(),
                       log.moving_warnings().end());
  }
  check.excitation = JudgeExcitation(log, check.sampling, check.motion);
  return check;
}

RecordingCheck CheckRecording(const Measurements& measurements) {
  return CheckRecording(Prepare(measurements));
}

std::string WhyNotConverged(const PreparedLog& log, FrictionKind kind) {
  for (const Excitation& one : CheckRecording(log).excitation) {
    if (one.kind == kind && !one.sufficient) return one.reason;
  }
  return "does the torque column hold friction?";
}

}  // namespace warmjoint

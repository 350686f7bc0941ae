// A sampled motion in pieces of one direction, and a bristle along it: how laws that have one remember where they came from.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "models/friction/sign.h"
#include "models/friction/thermal.h"

namespace warmjoint {

/// A part of the path between two samples, all in one direction.
struct MotionPiece {
  double travel;  // |dx|, rad or m
  double speed;   // at its end, rad/s or m/s
  int side;       // of its motion, 1 or -1
  double begin;   // of the time between the two samples, 0 to 1
  double end;
};

/// A motion whose velocity is linear from one sample to the next, cut at every turn of its
/// direction, and where the speed changes by more than a fiftieth, into kPieces of equal change.
class MotionPieces {
 public:
  static constexpr int kPieces = 4;

  /// time: [N] s, strictly increasing; velocity: [N] rad/s or m/s; starts: samples, above 0, at
  /// which another recording begins.
  MotionPieces(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity,
               const std::vector<Eigen::Index>& starts);

  Eigen::Index size() const { return velocity_.size(); }
  double velocity(Eigen::Index i) const { return velocity_[i]; }

  /// Whether a recording begins at sample i.
  bool Begins(Eigen::Index i) const { return begins_[static_cast<size_t>(i)]; }

  /// From the sample before to sample i; none where a recording begins or the joint rests.
  std::span<const MotionPiece> Before(Eigen::Index i) const {
    const size_t from = i == 0 ? 0 : end_[static_cast<size_t>(i - 1)];
    return std::span(pieces_).subspan(from, end_[static_cast<size_t>(i)] - from);
  }

 private:
  /// The time between two samples, of which `begin` to `end` has a velocity `from` to `to` without
  /// a turn. step: s, of it all.
  void Cut(double step, double begin, double end, double from, double to);

  Eigen::VectorXd velocity_;
  std::vector<bool> begins_;  // [N]
  std::vector<MotionPiece> pieces_;
  std::vector<size_t> end_;  // [N] one past the last piece before each sample
};

/// The bristle that a law brings, and the slope beside it.
template <typename T>
struct LawBristle {
  T stiffness;  // sigma0, N.m/rad or N/m
  T damping;    // sigma1, N.m.s/rad or N.s/m
  T slope;      // kv, N.m.s/rad or N.s/m
};

/// The bristle of law L from sample to sample. Its load s follows
///   ds/dx = sigma0 (1 - s / t) sign(v),   t = (g(|v|) + A) sign(v),
/// with the law's level g and whatever else joins it, A: heat, maps, load. Over a piece of travel
/// dx, on which t goes linearly from t0 to t1,
///   s' = t1 + (s - t0) exp(-q) - (t1 - t0) (1 - exp(-q)) / q,   q = sigma0 |dx| 2 / |t0 + t1|,
/// exact at constant speed and level, of second order else, and stable for any q. A level that A
/// takes below 0 counts as 0 for the bristle, and what it lacks takes from the viscous force.
/// L: a law with Level and BristleOf; T: double, or a dual number.
template <typename L, typename T = double>
class BristleState {
 public:
  /// p: of the law's table; stays where it is.
  explicit BristleState(const T* p) : p_(p), bristle_(L::BristleOf(p)) {}

  /// A recording begins at velocity v in steady sliding, or bent as its torque tells:
  /// s = tau - kv v, within the level. added: A, N.m or N.
  void BeginSliding(double v, double added) {
    level_ = L::Level(Sign(v), std::abs(v), p_);
    load_ = static_cast<double>(Sign(v)) * WithAdded(added);
  }
  void BeginBent(double v, double added, double torque) {
    level_ = L::Level(Sign(v), std::abs(v), p_);
    const T limit = WithAdded(added);
    const T carried = torque - bristle_.slope * v;
    load_ = carried > limit ? limit : carried < -limit ? T(-limit) : carried;
  }

  /// A recording begins at velocity v with a load s that is known, within the level or not.
  void BeginLoaded(double v, const T& load) {
    level_ = L::Level(Sign(v), std::abs(v), p_);
    load_ = load;
  }

  /// before, after: A on the piece's side at its begin and end, N.m or N.
  void Follow(const MotionPiece& piece, double before, double after) {
    using std::expm1;
    const T from = WithAdded(before);
    level_ = L::Level(piece.side, piece.speed, p_);
    const T to = WithAdded(after);
    const T q = bristle_.stiffness * (2 * piece.travel) / (from + to);
    const T gone = -expm1(-q);
    const double side = piece.side;
    load_ = side * to + (load_ - side * from) * (1.0 - gone) - side * (to - from) * gone / q;
  }

  /// F = s + sigma1 dz/dt + kv v, dz/dt = v - |v| s / (g + A), at the last sample. N.m or N
  T Force(double v, double added) const {
    const T force = load_ + bristle_.damping * Bending(v, added) + bristle_.slope * v;
    const T level = level_ + added;
    return added < 0 && level < T(0) ? T(force + static_cast<double>(Sign(v)) * level) : force;
  }

  /// W = F v - s dz/dt, what is not stored in the bristle, W.
  T Loss(double v, double added) const {
    return std::max(T(0), Force(v, added) * v - load_ * Bending(v, added));
  }

  /// s, N.m or N.
  const T& load() const { return load_; }

 private:
  T WithAdded(double added) const {
    const T level = level_ + added;
    return added < 0 && level < T(0) ? T(0) : level;
  }

  /// dz/dt, rad/s or m/s; 0 where there is no level to bend against.
  T Bending(double v, double added) const {
    const T level = WithAdded(added);
    return level == T(0) ? T(0) : T(v - std::abs(v) * load_ / level);
  }

  const T* p_;
  LawBristle<T> bristle_;
  T level_{0};  // g at the last sample or piece, N.m or N
  T load_{0};
};

}  // namespace warmjoint

// A sampled motion cut into pieces of one direction, as bristles follow it.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace warmjoint {

/// A part of the way between two samples, all in one direction.
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

}  // namespace warmjoint

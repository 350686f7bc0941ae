// LuGre's bristle along a recorded motion.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "models/friction/lugre.h"

namespace warmjoint::inline identification {

/// A motion whose velocity is linear from one sample to the next, cut at every turn of its
/// direction, and where the speed changes by more than a fiftieth, into kPieces of equal change.
class BristleCourse {
 public:
  static constexpr int kPieces = 4;

  /// time: [N] s, strictly increasing; velocity: [N] rad/s or m/s; starts: samples, above 0, at
  /// which another recording begins.
  /// torque: [N] N.m or N, which tells how the bristle is bent at each start; or empty.
  BristleCourse(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity,
                const std::vector<Eigen::Index>& starts, const Eigen::VectorXd& torque = {});

  Eigen::Index size() const { return velocity_.size(); }

  /// F of LuGre::BristleForce and the bristle's load s at every sample. At the start of each
  /// recording s = tau - kv v, within +-g, or without a torque as in steady sliding. Over a piece
  /// of travel dx, on which the level g goes linearly from g0 to g1,
  ///   s' = t1 + (s - t0) exp(-q) - (t1 - t0) (1 - exp(-q)) / q,   q = sigma0 |dx| 2 / (g0 + g1),
  /// t = g sign(v), solves ds/dx = sigma0 (1 - s / t) sign(v): exact at constant speed, of second
  /// order else, and stable for any q.
  /// p: {kv, kc, ks, vs, sigma0, sigma1}; force, load: [N] N.m or N.
  template <typename T>
  void Run(const T* p, T* force, T* load) const;

 private:
  struct Piece {
    double travel;  // |dx|, rad or m
    double speed;   // at its end, rad/s or m/s
    int side;       // of its motion, 1 or -1
  };

  void Cut(double step, double from, double to);

  Eigen::VectorXd velocity_;
  Eigen::VectorXd torque_;    // [N] or empty
  std::vector<bool> begins_;  // [N] whether a recording begins at the sample
  std::vector<Piece> pieces_;
  std::vector<size_t> end_;  // [N] one past the last piece before each sample
};

template <typename T>
void BristleCourse::Run(const T* p, T* force, T* load) const {
  using std::exp;
  using std::expm1;
  T level(0), s(0);
  size_t next = 0;
  for (Eigen::Index i = 0; i < size(); ++i) {
    const auto k = static_cast<size_t>(i);
    const double v = velocity_[i];
    if (begins_[k]) {
      level = LuGre::Level(Sign(v), std::abs(v), p);
      s = static_cast<double>(Sign(v)) * level;
      if (torque_.size() > 0) {
        const T carried = torque_[i] - p[0] * v;
        s = carried > level ? level : carried < -level ? T(-level) : carried;
      }
    }
    for (; next < end_[k]; ++next) {
      const Piece& piece = pieces_[next];
      const T after = LuGre::Level(piece.side, piece.speed, p);
      const T q = p[4] * (2 * piece.travel) / (level + after);
      const T gone = -expm1(-q);
      const double side = piece.side;
      s = side * after + (s - side * level) * (1.0 - gone) - side * (after - level) * gone / q;
      level = after;
    }
    force[i] = LuGre::BristleForce(v, s, level, p);
    load[i] = s;
  }
}

}  // namespace warmjoint::inline identification

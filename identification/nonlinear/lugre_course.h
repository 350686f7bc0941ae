// Torque of a LuGre law over a recorded motion, each recording bent at its start as suits it best.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "identification/nonlinear/lugre_fit.h"
#include "models/friction/bristle_course.h"

namespace warmjoint {

/// F + M a over all samples, and the loads s with which the R recordings begin.
template <typename T>
struct LugreCourse {
  std::vector<T> torque;  // [N] N.m or N
  std::vector<T> loads;   // [R] N.m or N
};

/// F and s over the samples of one recording, from its first to one before its end, by law L.
template <typename L, typename T>
struct LugreRun {
  std::vector<T> force, load;  // N.m or N

  /// load: s at its first sample; p: of the law's table.
  LugreRun(const MotionPieces& motion, Eigen::Index first, Eigen::Index end,
           const std::array<T, L::parameters.size()>& p, const T& begin) {
    BristleCourse<L, T> course(p.data());
    course.BeginLoaded(motion.velocity(first), begin);
    for (Eigen::Index i = first; i < end; ++i) {
      for (const MotionPiece& piece : motion.Before(i)) course.Follow(piece, 0, 0);
      force.push_back(course.Force(motion.velocity(i), 0));
      load.push_back(course.load());
    }
  }
};

/// b = dF/ds0 over the first samples of a recording, until less than 1e-9 of s0 is left: what a
/// load of 1 at its start adds to `run`, which began with 0.
template <typename L, typename T>
std::vector<T> ByLoad(const MotionPieces& motion, Eigen::Index first,
                      const std::array<T, L::parameters.size()>& p, const LugreRun<L, T>& run) {
  constexpr double kForgotten = 1e-9;
  BristleCourse<L, T> course(p.data());
  course.BeginLoaded(motion.velocity(first), T(1));
  std::vector<T> by_load;
  for (size_t k = 0; k < run.force.size(); ++k) {
    const Eigen::Index i = first + static_cast<Eigen::Index>(k);
    for (const MotionPiece& piece : motion.Before(i)) course.Follow(piece, 0, 0);
    by_load.push_back(course.Force(motion.velocity(i), 0) - run.force[k]);
    if (course.load() - run.load[k] < T(kForgotten)) break;
  }
  return by_load;
}

/// The torque at x. What a recording began with no sample tells alone: its first has the noise of
/// one, which a slow start carries along for the whole way that the bristle bends, many samples and
/// all with the same error. But the law is linear in s0, the load at the start,
///     F = F(s0 = 0) + b s0,   b = dF/ds0, which dies away as exp(-sigma0 |x| / g),
/// so that least squares give it at any x (variable projection, Golub and Pereyra 1973):
///     s0 = sum b (tau - F(s0 = 0) - M a) / d^2 / (sum b^2 / d^2 + 1 / q^2)
/// over the used samples with their deviations d. q, the rms of the torque, keeps s0 near 0 where
/// none of them tells. Derivatives by x go through s0, so that a covariance from them knows that it
/// was estimated, too. x: as LugrePoint has it.
template <typename L, typename T>
LugreCourse<T> FollowLugre(const LugreProblem& problem, const T* x) {
  const Eigen::Index n = problem.motion.size();
  const auto p = LugreValues<L>(x);
  const T& inertia = x[problem.inertia()];
  LugreCourse<T> course;
  course.torque.reserve(static_cast<size_t>(n));
  Eigen::Index row = 0;  // of the used samples
  for (Eigen::Index first = 0, end = 0; first < n; first = end) {
    end = problem.EndOfRecording(first);
    const LugreRun<L, T> run(problem.motion, first, end, p, T(0));
    const std::vector<T> by_load = ByLoad<L>(problem.motion, first, p, run);

    // from a start without load, and what the samples tell of it
    T told(0), weight(static_cast<double>(n) / problem.torque.squaredNorm());
    for (Eigen::Index i = first; i < end; ++i) {
      const auto k = static_cast<size_t>(i - first);
      course.torque.push_back(run.force[k] + inertia * problem.acceleration[i]);
      if (!problem.used.keep[i]) continue;
      const double deviation = problem.deviation[row++];
      if (k >= by_load.size()) continue;
      const T weighted = by_load[k] / (deviation * deviation);
      told += weighted * (problem.torque[i] - course.torque.back());
      weight += weighted * by_load[k];
    }

    // from the load that suits them
    course.loads.push_back(told / weight);
    for (size_t k = 0; k < by_load.size(); ++k) {
      course.torque[static_cast<size_t>(first) + k] += by_load[k] * course.loads.back();
    }
  }
  return course;
}

}  // namespace warmjoint

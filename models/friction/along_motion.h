// The forward model: what a joint's friction does along a motion that is recorded or prescribed.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/friction/course_start.h"
#include "models/friction/friction_description.h"
#include "models/friction/joint_friction.h"

namespace warmjoint::inline models {

/// What a joint does and meets at N samples. A column that is empty is 0 throughout.
struct JointCourse {
  Eigen::VectorXd time;              // [N] s, strictly increasing
  Eigen::VectorXd velocity;          // [N] rad/s or m/s
  Eigen::VectorXd position{};        // [N] rad or m
  Eigen::VectorXd motor_position{};  // [N] rad; empty: the gear times the position
  Eigen::VectorXd load{};            // [N] that the joint transmits, N.m or N
  Eigen::VectorXd ambient_rise{};    // [N] Ts - T0, K
  Eigen::VectorXd level{};           // [N] A, what else joins E, N.m or N
  /// [N] rad/s or m/s, for the loss of laws without a bristle of their own: mean of |v| until the next
  /// sample, and mean of v^2 over that, with the sign of v; both empty: |v| and v
  Eigen::VectorXd mean_speed{};
  Eigen::VectorXd loss_velocity{};
  /// [N] N.m or N: tells how a bristle is bent where a recording begins; empty: as in steady sliding
  Eigen::VectorXd torque{};
  /// Samples, above 0 and ascending, at which another recording begins: the joint is cold again.
  std::vector<Eigen::Index> starts{};
  double step = 0;  // s, where it is known to be the same throughout; 0: as `time` tells
};

/// Friction along a motion of N samples.
struct Prediction {
  Eigen::VectorXd force;    // [N] F, N.m or N; 0 at rest, but for a bristle's load
  Eigen::VectorXd energy;   // [N] E1 + E2, N.m or N; as at first where nothing warms
  Eigen::VectorXd loss;     // [N] W, W
  Eigen::VectorXd bristle;  // [N] load of the law's own bristle, N.m or N; empty: it has none
  /// First sample at which warm friction pushes instead of braking and so feeds itself; N if none.
  Eigen::Index feeds_itself = 0;
  FrictionState end;  // at the last sample
};

/// One joint's friction as a model of its torque. Laws without a bristle of their own slide
/// steadily wherever the joint moves, by JointFriction::SlidingForce,
///   F = Fn(v) + b E v + sign(v) (E + A + c |load|) + maps                           (20)
///   W = |F v|, or the mean speed times F at the loss velocity where both are given  (19)
/// and carry at rest what the motion does not tell, for which F is 0. Others bring a Course in
/// their own header (bristle_course.h) that follows the motion, and lose what they do not store.
/// E1 and E2 take the exact step of Heat, Eq. (22), over each interval.
class AlongMotion {
 public:
  /// friction: checked (CheckFriction), or one with all values of its law, within bounds or not.
  explicit AlongMotion(const FrictionDescription& friction);

  Prediction Predict(const JointCourse& course, const CourseStart& start = {}) const;

  /// The friction at one place, as JointFriction tells it.
  const JointFriction& joint() const { return joint_; }

 private:
  FrictionDescription friction_;
  JointFriction joint_;
};

}  // namespace warmjoint::inline models

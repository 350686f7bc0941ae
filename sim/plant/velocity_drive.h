// The velocity controller of a simulated joint.
#pragma once

namespace warmjoint::inline sim {

/// PI control of velocity with feedforward of the inertia:
///   torque = M a_ref + kp e + ki integral(e),  e = v_ref - v,  kp = 2 M w,  ki = M w^2,
/// which places both poles of the closed loop at the bandwidth w.
class VelocityDrive {
 public:
  /// inertia: M, kg.m^2 or kg; bandwidth: w, rad/s; h: step, s.
  VelocityDrive(double inertia, double bandwidth, double h)
      : inertia_(inertia),
        proportional_(2 * inertia * bandwidth),
        integral_(inertia * bandwidth * bandwidth * h) {}

  /// Torque of this step, N.m or N.
  double Torque(double reference, double acceleration, double velocity) {
    const double error = reference - velocity;
    sum_ += integral_ * error;
    return inertia_ * acceleration + proportional_ * error + sum_;
  }

 private:
  double inertia_;
  double proportional_;  // kp
  double integral_;      // ki h
  double sum_ = 0;       // ki integral(e)
};

}  // namespace warmjoint::inline sim

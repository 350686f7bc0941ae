#include "sim/plant/ideal_friction.h"

#include "models/friction/joint_friction.h"

namespace warmjoint::inline sim {
namespace {

double At(const Eigen::VectorXd& values, Eigen::Index i) {
  return values.size() > 0 ? values[i] : 0.0;
}

}  // namespace

FrictionHistory SimulateFriction(const FrictionDescription& friction, double initial_energy,
                                 double step, const JointCourse& course, const Place& place) {
  const JointFriction joint(friction);
  const Heat heat = DiscretiseHeat(friction, step);

  const Eigen::Index n = course.velocity.size();
  FrictionHistory history{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  double energy = initial_energy;
  double second_energy = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double v = course.velocity[i];
    const double stored = energy + second_energy;
    const double level = stored + At(course.level, i);
    const JointPlace here{At(course.position, i), stored, At(course.load, i)};
    const double force = joint.SlidingForce(v, here) + Sign(v) * At(course.level, i);
    if (FeedsItself(v, force)) {
      Refuse(place,
             "at {:g} s friction feeds itself: at a velocity of {:g} the energy state {:g} exceeds "
             "the nominal friction, so that F = {:g} pushes; move slower before, rest, or lower "
             "the thermal gain",
             static_cast<double>(i) * step, v, level, force);
    }
    const double loss = Loss(v, force);
    history.force[i] = force;
    history.loss[i] = loss;
    history.energy[i] = stored;
    energy = heat.First(energy, loss, At(course.ambient_rise, i));
    second_energy = heat.Second(second_energy, loss);
  }
  return history;
}

}  // namespace warmjoint::inline sim

// The value of a friction: what a joint does at one place, from step to step, and along a motion.
//
//   const Friction friction = ReadFriction("estimate.json");
//   const FrictionModel model(friction);
//   const double cold = model.Force(0.5);                                    // N.m at 0.5 rad/s
//   const double warm = model.Force(0.5, {.energy = SettledEnergy(friction, 0.5)->at(0)});
#pragma once

#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

namespace warmjoint {

/// Where a joint is, besides its direction and speed.
struct JointPlace {
  double position = 0;                     // rad or m
  double energy = 0;                       // E of all stages together, N.m or N
  double load = 0;                         // that the joint transmits, N.m or N, signed
  std::optional<double> motor_position{};  // rad; not given: the gear times the position
};

/// What one joint's friction remembers.
struct FrictionState {
  double bristle = 0;        // load that the bristle carries, N.m or N
  double energy = 0;         // E1, N.m or N
  double second_energy = 0;  // E2, N.m or N
  double slip = 0;           // -1, 0 or 1: direction in which a joint that broke away slides
};

/// What a joint does during one step.
struct JointMotion {
  double position = 0;      // rad or m
  double velocity = 0;      // rad/s or m/s
  double inertia = 0;       // effective inertia M, kg.m^2 or kg
  double load = 0;          // that the joint transmits, N.m or N
  double ambient_rise = 0;  // Ts - T0, K
};

/// What one step of friction yields.
struct FrictionStep {
  double force = 0;           // F, N.m or N; acts against the motion as -F
  double loss = 0;            // W, W
  bool drives_joint = false;  // the sliding force would not brake; 0 was used instead
  bool sliding = false;       // in the direction of the motion
  FrictionState next;
};

/// A change of E that no loss explains, as in a gap of the log.
struct EnergyJump {
  Eigen::Index sample = 0;
  double change = 0;  // N.m or N
};

/// What a joint remembers as a motion begins, and what else is known of E.
struct ThermalStart {
  double energy = 0;                // E1, N.m or N
  double second_energy = 0;         // E2, N.m or N
  std::vector<EnergyJump> jumps{};  // of E1, their samples ascending
};

/// What a joint does and meets at N samples. A column that is empty is 0 throughout.
struct JointTrajectory {
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
  /// First sample at which warm friction drives the joint instead of braking it; N if none.
  Eigen::Index first_driving = 0;
  FrictionState end;  // at the last sample
};

/// The energies E1 and, with a second stage, E2, in N.m or N, of a joint that has slid at
/// `velocity`, rad/s or m/s, for much longer than its time constants, in surroundings at T0: Eq.
/// (21) with s = 0, E_i = k_i W and W = |F v| (19). Where friction is F0 + E, with F0 the cold one
/// at that velocity, this is
///   E = k |v| |F0| / (1 - k |v|),   k = k1 + k2;
/// with maps W is the mean over the positions that they cover (no load). Solved by bisection to
/// double precision, so that maps over energy and viscous_per_energy take part as they are.
/// Empty without heat; nothing where the losses grow for ever (k |v| >= 1).
/// Throws BadInput as CheckFriction does.
std::optional<std::vector<double>> SettledEnergy(const Friction& friction, double velocity);

/// The value of a friction. Cheap to copy, safe to use from many threads.
class FrictionModel {
 public:
  /// timestep: of Step, s, above 0. Throws BadInput as CheckFriction does.
  explicit FrictionModel(const Friction& friction, double timestep = 0.001);

  /// F of steady sliding, N.m or N: Eq. (20) of the paper with maps; 0 at velocity 0, where friction carries what it is
  /// loaded with, up to HoldingLevel. velocity: rad/s or m/s.
  double Force(double velocity, const JointPlace& place = {}) const;

  /// The largest load that the cold joint holds at rest, N.m or N.
  double HoldingLevel() const;

  /// One step of the kernel that the MuJoCo plugin runs: sticking by a bristle, the heat by its exact zero-order hold.
  FrictionStep Step(const FrictionState& state, const JointMotion& motion) const;

  /// Friction and heat along a motion that is known. Throws BadInput for columns of unlike length and time that does not
  /// increase.
  Prediction Along(const JointTrajectory& motion, const ThermalStart& start = {}) const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace warmjoint

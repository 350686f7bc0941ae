// The friction of one joint as data, and its value.
//
//   const Friction friction = ReadFriction("estimate.json");
//   const FrictionModel model(friction);
//   const double cold = model.Force(0.5);                                    // N.m at 0.5 rad/s
//   const double warm = model.Force(0.5, {.energy = SettledEnergy(friction, 0.5)->at(0)});
#pragma once

#include <warmjoint/recording.h>

#include <limits>

namespace warmjoint::api {

/// Parameters of E = k / (1 + s tau) W: the level E that the losses W = |F v| add to friction.
struct Thermal {
  double gain = 0;           // k, N.m/W or N/W; negative where friction falls as the joint warms
  double time_constant = 1;  // tau, s
};

/// Gaussian kernels over one quantity.
struct MapAxis {
  std::string quantity{};          // position, motor_position, velocity, energy or load
  std::vector<double> centres{};   // ascending; rad or m, rad, rad/s or m/s, N.m or N, N.m or N
  double width = 1;                // in the unit of the centres
  std::optional<double> period{};  // of a circle
  bool sides_apart = false;        // kernels do not reach across 0
};

/// A force that is added to the law's: factor(v) sum_i weight_i kernel_i.
struct FrictionMap {
  std::vector<MapAxis> axes{};  // one to four
  bool normalised = true;       // kernels are divided by their sum
  std::string factor = "one";   // one, direction (sign v) or velocity (v)
  std::vector<double>
      weights{};  // one for each product of kernels, the last axis's index the fastest; N.m or N
};

/// A nominal law with its values, and optionally its warming, load and maps:
///   F = (kv + b E) v + sign(v) (g + E + c |load|) + maps,
/// g the law's level, E = E1 + E2 the heat, b viscous_per_energy, c load_gain.
struct Friction {
  std::string law = "viscous_coulomb";
  std::map<std::string, double> parameters{};  // SI; one for each of the law's table (Laws)
  std::optional<Thermal> thermal{};
  std::optional<Thermal> second_thermal{};  // a second stage, fed by the same loss
  double ambient = 0;                       // temperature at which the parameters hold, degC
  double gear = 1;                          // motor turns for each joint turn, rad of motor per m
  double level_per_temperature = 0;         // N.m/K or N/K; 0: none
  double viscous_per_energy = 0;            // b, s/rad or s/m
  double load_gain = 0;                     // c, dimensionless
  std::string torque_unit{};  // "A" of one in amperes, which MuJoCo cannot use; else empty
  std::vector<FrictionMap> maps{};
};

/// What is known of a parameter before any data.
struct ParameterInfo {
  std::string name, symbol;
  std::string rotary_unit, linear_unit;
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double default_value = 0;
  std::string meaning{};
};

/// A nominal law: its name, formula and parameters.
struct LawInfo {
  std::string name, equation;
  std::vector<ParameterInfo> parameters{};
};

/// All laws, as `warmjoint list laws` has them.
std::vector<LawInfo> Laws();

/// Checks names, bounds and that the parts make sense together. Throws BadInput.
void CheckFriction(const Friction& friction);

/// Reads a friction file: an estimate.json, or its member `friction` alone. Throws BadInput.
Friction ReadFriction(const std::filesystem::path& file);

/// The `friction` member of estimate.json from a text. name: of the text, in messages. Throws BadInput.
Friction FrictionFromJson(const std::string& text, const std::string& name = "friction");

/// The inverse, indented by two. Throws BadInput where CheckFriction does.
std::string FrictionToJson(const Friction& friction);

/// E1, and E2 of a second stage, in N.m or N, at which a joint settles that slides at `velocity` (rad/s or m/s) for long;
/// empty without heat; nothing where its losses would grow for ever. Throws BadInput.
std::optional<std::vector<double>> SettledEnergy(const Friction& friction, double velocity);

/// Where a joint is, besides its velocity.
struct JointPlace {
  double position = 0;                     // rad or m
  double energy = 0;                       // E1 + E2, N.m or N
  double load = 0;                         // that the joint transmits, N.m or N
  std::optional<double> motor_position{};  // rad; the gear times the position where not given
};

/// What a joint remembers from step to step.
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
  double inertia = 0;       // effective, kg.m^2 or kg
  double load = 0;          // N.m or N
  double ambient_rise = 0;  // ambient less Friction::ambient, K
};

/// What one step yields.
struct FrictionStep {
  double force = 0;  // F, N.m or N; acts against the motion as -F
  double loss = 0;   // W, W
  FrictionState next{};
};

/// What a joint does at N samples; empty columns are 0 throughout.
struct Motion {
  std::vector<double> time{};            // [N] s, strictly increasing
  std::vector<double> velocity{};        // [N] rad/s or m/s
  std::vector<double> position{};        // [N] rad or m
  std::vector<double> motor_position{};  // [N] rad; empty: the gear times the position
  std::vector<double> load{};            // [N] N.m or N
  std::vector<double> ambient_rise{};    // [N] K
  std::vector<std::size_t> starts{};     // samples at which the joint is cold again
};

/// The motion that a recording holds. Throws BadInput as PreparedLog does, and where it has no velocity.
Motion MotionOf(const Recording& recording);

/// Friction along a motion of N samples.
struct FrictionCourse {
  std::vector<double> force{};   // [N] F, N.m or N; 0 at rest
  std::vector<double> energy{};  // [N] E1 + E2, N.m or N
  std::vector<double> loss{};    // [N] W
  FrictionState end{};           // at the last sample
};

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

  /// Friction and heat along a motion that is known, from E1 and E2 at its first sample on. Throws BadInput for columns of
  /// unlike length and time that does not increase.
  FrictionCourse Along(const Motion& motion, double energy = 0, double second_energy = 0) const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace warmjoint::api

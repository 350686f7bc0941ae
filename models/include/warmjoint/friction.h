// The friction of one joint as data: what a friction file holds, and what estimates, scenarios, the plugin and `attach` exchange.
//
//   const Friction friction = ReadFriction("estimate.json");
//   std::printf("%s %g\n", friction.law.c_str(), friction.parameters.at("coulomb"));
#pragma once

#include <warmjoint/field.h>

#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace warmjoint {

/// Rotary joints have rad and N.m, linear ones m and N.
enum class JointKind { rotary, linear };

inline std::span<const Word<JointKind>> WordsOf(JointKind) {
  static constexpr std::array words{Word{"rotary", JointKind::rotary},
                                    Word{"linear", JointKind::linear}};
  return words;
}

/// A unit for each kind of joint, for example {"N.m", "N"}.
struct JointUnit {
  std::string_view rotary;
  std::string_view linear;
  int displacement = 0;  // power of rad or m beside torque or force
  int time = 0;          // power of s

  constexpr std::string_view For(JointKind kind) const {
    return kind == JointKind::rotary ? rotary : linear;
  }
};

inline constexpr JointUnit kPositionUnit{"rad", "m", 1, 0};
inline constexpr JointUnit kVelocityUnit{"rad/s", "m/s", 1, -1};
inline constexpr JointUnit kTorqueUnit{"N.m", "N"};
inline constexpr JointUnit kViscousUnit{"N.m.s/rad", "N.s/m", -1, 1};
inline constexpr JointUnit kStiffnessUnit{"N.m/rad", "N/m", -1, 0};
inline constexpr JointUnit kLevelPerTemperatureUnit{"N.m/K", "N/K"};
inline constexpr JointUnit kTimePerPositionUnit{"s/rad", "s/m", -1, 1};
inline constexpr JointUnit kThermalGainUnit{"N.m/W", "N/W", -1, 1};

/// Whether files must give a parameter or may leave it at its default.
enum class Given { always, or_default };

/// What of its law's force a parameter is, for code that must tell one parameter from another, whatever the law. A law
/// has at most one of each, but for a level to each direction.
enum class LawPart {
  other,
  slope,       // over speed
  level,       // while it slides
  rest_level,  // at rest
  rest_rise,   // of the level at rest over that while it slides
  bristle,     // stiffness of the law's own
};

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What is known of a parameter before any data: every law and the thermal state carry a table of
/// these, from which checks, regressors, documentation and plots are made.
struct ParameterInfo {
  std::string_view name;    // as in files and on the command line
  std::string_view symbol;  // as in the paper
  JointUnit unit;
  double lower = 0;          // smallest allowed value
  double upper = kInfinity;  // largest allowed value
  double default_value = 0;
  std::string_view meaning;  // one short phrase
  Given given = Given::always;
  LawPart part = LawPart::other;
};

/// Lower bound of what must be positive, in SI.
inline constexpr double kSmallestPositive = 1e-9;

/// How friction acts on a joint that is held.
///   elastoplastic: a spring that yields at the level of sliding (bristle.h)
///   breakaway:     the same, but held it bears up to a static level above that of sliding, Eq. (4)
///   bristle:       a spring with given stiffness and damping that relaxes with travel
enum class PreSliding { elastoplastic, breakaway, bristle };

/// A nominal law behind one interface, made from the law's own struct.
struct Law {
  std::string_view name;
  std::string_view equation;
  std::span<const ParameterInfo> parameters;
  /// Force of steady sliding in N.m or N at velocity v (rad/s or m/s); p: one value for each of
  /// `parameters`.
  double (*force)(double v, const double* p);
  /// The load in N.m or N that a joint at rest bears before it slides to `side`, 1 or -1.
  double (*holding_level)(int side, const double* p);
  PreSliding pre_sliding;
};

/// All laws, in the order of their list (models/friction/laws.h).
const std::vector<Law>& Laws();

/// The law of that name, or nullptr.
const Law* FindLaw(std::string_view name);

/// Names of all laws, in the order of the list.
std::vector<std::string> LawNames();

/// Parameters of E = k / (1 + s tau) W, Eq. (21): a first-order lag from the power lost, W, to the
/// change of the friction level, E. k is negative where friction falls as the joint warms.
struct Thermal {
  double gain = 0;           // k, N.m/W or N/W
  double time_constant = 1;  // tau, s

  static constexpr std::array parameters{
      ParameterInfo{"thermal_gain", "k", kThermalGainUnit, -kInfinity, kInfinity, 0,
                    "change of the level for each watt lost, once settled"},
      ParameterInfo{"thermal_time_constant",
                    "tau",
                    {"s", "s", 0, 1},
                    0,
                    kInfinity,
                    600,
                    "time constant of warming and cooling"},
  };

  template <class A>
  void Serialize(A* a) {
    const auto& [k, tau] = parameters;
    a->Field(k.name, &gain, {.unit = k.unit.rotary, .meaning = k.meaning, .needed = kGiveNumber});
    a->Field(tau.name, &time_constant,
             {.unit = tau.unit.rotary,
              .bounds = {.above = 0},
              .meaning = tau.meaning,
              .needed = kGiveNumber});
  }
};

/// Whether kernels are divided by their sum, Eq. (16). Normalised ones keep the value of the
/// nearest centre outside of the centres, where plain ones fall to 0.
enum class KernelKind { plain, normalised };

inline std::span<const Word<KernelKind>> WordsOf(KernelKind) {
  static constexpr std::array words{Word{"normalised", KernelKind::normalised},
                                    Word{"plain", KernelKind::plain}};
  return words;
}

/// Whether kernels reach across 0. Friction jumps there, so kernels over velocity stay apart.
enum class Sides { together, apart };

inline std::span<const Word<Sides>> WordsOf(Sides) {
  static constexpr std::array words{Word{"together", Sides::together}, Word{"apart", Sides::apart}};
  return words;
}

/// Evenly or freely spaced Gaussian kernels kappa_i(x) = exp(-(x - c_i)^2 / (2 s^2)).
struct GaussianAxis {
  std::vector<double> centres;  // none is 0 where the sides are apart
  double width = 1;
  std::optional<double> period;
  Sides sides = Sides::together;

  size_t size() const { return centres.size(); }

  template <class A>
  void Serialize(A* a) {
    a->Field("centres", &centres,
             {.meaning = "c, ascending, in the quantity's unit", .needed = "give numbers"});
    a->Field("width", &width,
             Needed("", "s, standard deviation of the kernels, in the same unit", kPositive,
                    "give a number"));
    a->Field(
        "period", &period,
        WithDefault("", "of a circle: distances are wrapped to half of it; 2 pi for motor_position",
                    kPositive));
    a->Field("sides", &sides,
             {.meaning = "apart: kernels at positive centres act on positive values alone, and "
                         "likewise for negative ones"});
  }
};

/// Even centres from `first` to `last`, with a width of one spacing.
GaussianAxis EvenAxis(double first, double last, int count);

/// Even centres on a circle, the first at 0, with a width of one spacing. period: rad, say.
GaussianAxis CircleAxis(double period, int count);

/// Even centres over both directions of motion, -highest ... -lowest, lowest ... highest, with a
/// width of one spacing, kept apart. count: centres for each direction.
GaussianAxis SpeedAxis(double lowest, double highest, int count);

/// What a map can depend on.
enum class MapQuantity { position, motor_position, velocity, energy, load };

std::span<const Word<MapQuantity>> WordsOf(MapQuantity);

/// Where a joint is: one value for each MapQuantity, in its order: rad or m, rad, rad/s or m/s,
/// N.m or N, N.m or N.
template <typename T>
using MapPoint = std::array<T, 5>;

struct MapAxis {
  MapQuantity quantity = MapQuantity::position;
  GaussianAxis kernels;

  template <class A>
  void Serialize(A* a) {
    a->Field("quantity", &quantity,
             {.meaning = "what the map depends on", .needed = "name what the map depends on"});
    kernels.Serialize(a);
  }
};

/// 1, sign(v) (a level that acts against the motion) or v
/// (viscous friction). With `velocity` a map over energy is kv(E) v of Eq. (27).
enum class MapFactor { one, direction, velocity };

std::span<const Word<MapFactor>> WordsOf(MapFactor);

inline constexpr size_t kMostMapAxes = 4;
inline constexpr size_t kMostMapCentres = 128;  // of one axis

/// A force that is added to the law's: factor(v) sum_i w_i kappa_i, Eqs. (10)-(16), where kappa_i
/// is the product of one kernel of each axis (diagonal covariance). A normalised product of kernels
/// is the product of the normalised ones. As part of F it takes part in the losses W = |F v|, (19).
struct FrictionMap {
  std::vector<MapAxis> axes;
  KernelKind kernels = KernelKind::normalised;
  std::vector<double> weights;
  MapFactor factor = MapFactor::one;

  /// Number of kernels that the axes span.
  size_t size() const;

  template <class A>
  void Serialize(A* a) {
    a->Field(
        "axes", &axes,
        {.meaning = "one to four; the kernels of a map are all products of one kernel of each axis",
         .needed = "give a list"});
    a->Field("kernels", &kernels,
             {.meaning = "normalised, Eq. (16): divided by their sum; plain: as they are"});
    a->Field(
        "factor", &factor,
        {.meaning =
             "what the kernels are multiplied by: 1, the sign of the velocity, or the velocity"});
    a->Field("weights", &weights,
             Needed("N.m",
                    "one for each product of kernels, the last axis the fastest; over rad/s where "
                    "the factor is velocity",
                    {}, "give a number for each kernel"));
  }
};

/// The map's axis over that quantity, or nullptr.
const MapAxis* FindAxis(const FrictionMap& map, MapQuantity quantity);

/// The heat of a friction as files hold it.
struct Warming {
  Thermal first;
  double ambient = 0;             // degC
  std::optional<Thermal> second;  // stage

  template <class A>
  void Serialize(A* a) {
    first.Serialize(a);
    a->Field("ambient", &ambient, WithDefault("degC", "temperature at which the law holds"));
    a->Field("second", &second, {.meaning = "a second stage of warming, fed by the same loss"});
  }
};

struct FrictionOption;

/// level_per_temperature, viscous_per_energy, load_gain; 0 is the default and changes nothing.
std::span<const FrictionOption> FrictionOptions();

/// A nominal law with its values, and optionally its warming, load and maps:
///   F = (kv + b E) v + sign(v) (g + E + c |load|) + sum of the maps
/// with g the law's level, E = E1 + E2 the heat (thermal.h), b viscous_per_energy, c load_gain.
struct Friction {
  std::string law = "viscous_coulomb";
  std::map<std::string, double> parameters;  // SI; one for each of the law's table
  std::optional<Thermal> thermal;
  double ambient = 0;  // temperature at which the law's parameters hold, degC
  double gear = 1;     // motor turns for each joint turn (rotary), rad of motor per m (linear)
  std::vector<FrictionMap> maps{};          // friction that depends on position, energy, load
  std::optional<Thermal> second_thermal{};  // a second stage of warming, fed by the same loss
  double level_per_temperature = 0;         // of the temperature form, N.m/K or N/K; 0: none
  double viscous_per_energy = 0;            // b of Eq. (27), s/rad or s/m
  double load_gain = 0;                     // c, level for each unit of |load|, dimensionless
  std::string torque_unit{};  // "A" of a friction in amperes, which MuJoCo cannot use; else empty

  template <class A>
  void Serialize(A* a);
};

/// Friction for one joint of a model.
struct FrictionForJoint {
  std::string joint;
  Friction friction;
  std::vector<double> initial_energy{};  // E1, and E2 of a second stage, N.m or N; empty: cold

  template <class A>
  void Serialize(A* a) {
    a->Field("joint", &joint, {.needed = "give a name or pattern"});
    a->Field("friction", &friction, {.needed = "give a friction"});
    a->Field("initial_energy", &initial_energy, {.unit = "N.m"});
  }
};

/// What beside a law's own parameters shapes friction and is a number: its name and bounds, and
/// where it is. Documented, read and written by this one table.
struct FrictionOption {
  ParameterInfo info;
  double Friction::*value;
};

template <class A>
void Friction::Serialize(A* a) {
  a->Field("law", &law, {.meaning = "nominal law", .needed = "give one of its names as text"});
  a->Field("parameters", &parameters, {.meaning = "of the law, SI"});
  a->Field("gear", &gear, {.meaning = "motor turns for each joint turn"});
  // heat stands in one map
  std::optional<Warming> warming;
  if (thermal) warming = Warming{*thermal, ambient, second_thermal};
  a->Field("thermal", &warming,
           {.meaning = "warming, Eqs. (20) to (22); without it the friction stays cold"});
  if (warming) {
    thermal = warming->first;
    ambient = warming->ambient;
    second_thermal = warming->second;
  }

  // what changes nothing is left out
  constexpr auto left_out = AtDefault::left_out;
  for (const FrictionOption& option : FrictionOptions()) {
    a->Field(option.info.name, &(this->*option.value),
             {.unit = option.info.unit.rotary,
              .bounds = {.at_least = option.info.lower, .at_most = option.info.upper},
              .meaning = option.info.meaning,
              .at_default = left_out});
  }
  a->Field("torque_unit", &torque_unit, LeftOut("A, where torque is a current"));
  a->Check(torque_unit.empty() || torque_unit == "A", "torque_unit", "A, or absent");
  a->Field(
      "maps", &maps,
      LeftOut("friction over position, motor angle, velocity, energy or load, Eqs. (10) to (16)"));
}

/// Gives the parameters that may be left out their defaults, where they are missing.
void FillDefaults(Friction& friction);

/// The law's parameter values in the order of its table. The description must have been checked
/// (CheckFriction).
std::vector<double> LawValues(const Friction& friction);

/// Checks names and bounds against the parameter tables, and that all parts make sense together:
///   static >= coulomb; what depends on E needs thermal; viscous_per_energy needs a law with a
///   slope, and a slope that falls as the joint warms; maps over motor_position lie on the circle.
/// Throws BadInput.
void CheckFriction(const Friction& friction);

/// Reads a friction file: an object with a `friction` member (as in estimate.json) or that member by itself. Throws
/// BadInput.
Friction ReadFriction(const std::filesystem::path& file);

/// The text of a friction file, and the inverse; checked. name: of the text, in messages. Throws BadInput.
std::string FrictionToJson(const Friction& friction);
Friction FrictionFromJson(const std::string& text, const std::string& name = "friction");

/// A friction in a file is read so.
void ReadValue(const Node& node, Friction* value, const FieldInfo& info);

}  // namespace warmjoint

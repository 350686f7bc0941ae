// Friction as the numbers that engines without heat, maps and directions take, and what these numbers leave out; and the formats
// that hold all of it.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/friction.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "models/friction/compensator.h"

namespace warmjoint {

/// Whose numbers are asked for; c, cpp and python: code of a controller (controller_code.h); ros2 and ur: its parameters
/// (controller_text.h); fmu: FMI 3.0 (fmu_text.h).
enum class EngineFormat { mjcf, urdf, physx, isaaclab, mjlab, ur, c, cpp, python, ros2, fmu };

inline std::span<const Word<EngineFormat>> WordsOf(EngineFormat) {
  static constexpr std::array words{
      Word{"mjcf", EngineFormat::mjcf},     Word{"urdf", EngineFormat::urdf},
      Word{"physx", EngineFormat::physx},   Word{"isaaclab", EngineFormat::isaaclab},
      Word{"mjlab", EngineFormat::mjlab},   Word{"ur", EngineFormat::ur},
      Word{"c", EngineFormat::c},           Word{"cpp", EngineFormat::cpp},
      Word{"python", EngineFormat::python}, Word{"ros2", EngineFormat::ros2},
      Word{"fmu", EngineFormat::fmu}};
  return words;
}

/// Whether heat is a state there; the others take the numbers of one warmth.
inline bool HasHeat(EngineFormat format) { return format >= EngineFormat::c; }

/// Whether it has a level at rest besides that of sliding.
inline bool HasStaticLevel(EngineFormat format) {
  return format == EngineFormat::physx || format == EngineFormat::isaaclab;
}

/// How warm the joint is: a share of the heat at which sliding at a speed settles.
struct Warmth {
  double share = 0;             // 0 cold, 1 settled
  std::optional<double> speed;  // rad/s or m/s; none: the log's median, else 1 rad/s or 0.1 m/s
};

/// A joint with its friction, and the speeds at which it was seen.
struct SeenFriction {
  std::string joint;
  Friction friction;
  JointKind kind = JointKind::rotary;
  std::vector<double> speeds{};     // |v| of a log, rad/s or m/s; empty: no log is known
  std::optional<double> inertia{};  // kg.m^2 or kg
  std::optional<double>
      half_width{};  // of the friction at the speed where it is known best, N.m or N
  std::map<std::string, std::array<double, 2>> intervals{};  // of its parameters, 95 %
  FrictionDoubt doubt{};
};

/// The friction of an estimate. Throws BadInput, from `file`, where it holds none, or one in amperes.
SeenFriction SeenOf(const std::string& joint, const Estimate& estimate, const std::string& file);

/// What the numbers do not say.
struct Omission {
  std::string what;  // asymmetry, speed, rest, heat, position, load, creep
  std::optional<double>
      percent;          // of the mean friction over the speeds; none where no size is known
  std::string meaning;  // one sentence

  template <class A>
  void Serialize(A* a) {
    a->Field("what", &what);
    a->Field("percent", &percent, OrNull("of the mean friction over the speeds"));
    a->Field("meaning", &meaning);
  }
};

/// F = viscous v + level sign(v), nearest to the friction at that warmth over the speeds in both directions, by
/// least squares with neither below 0.
struct EngineFriction {
  std::string joint;
  JointKind kind = JointKind::rotary;
  double warm = 0;
  double speed = 0;    // at which 1 has settled, rad/s or m/s
  double energy = 0;   // E there, N.m or N
  double slowest = 0;  // of the speeds, rad/s or m/s
  double fastest = 0;
  double viscous = 0;       // N.m.s/rad or N.s/m
  double level = 0;         // while it slides, N.m or N
  double static_level = 0;  // at rest, not below `level`, N.m or N
  std::vector<Omission> left_out;
  std::optional<double> half_width{};  // of SeenFriction, which a text's digits follow
  std::optional<double> inertia{};     // of SeenFriction

  /// Without its name, by which a file has it, and with all digits.
  template <class A>
  void Serialize(A* a) {
    a->Field("kind", &kind);
    a->Field("warm", &warm);
    a->Field("speed", &speed, {.unit = "rad/s"});
    a->Field("energy", &energy, {.unit = "N.m"});
    a->Field("slowest", &slowest, {.unit = "rad/s"});
    a->Field("fastest", &fastest, {.unit = "rad/s"});
    a->Field("viscous", &viscous, {.unit = "N.m.s/rad"});
    a->Field("level", &level, {.unit = "N.m"});
    a->Field("static_level", &static_level, {.unit = "N.m"});
    a->Field("left_out", &left_out);
  }
};

/// Of one joint. Throws BadInput for a share below 0, a speed of 0 or one at which the losses grow for ever.
EngineFriction InEngine(const SeenFriction& seen, const Warmth& warmth, EngineFormat format);

}  // namespace warmjoint

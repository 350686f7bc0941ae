// A friction in the numbers of <warmjoint/compensate.h>, with the arrays of its maps.
#pragma once

#include <warmjoint/compensate.h>
#include <warmjoint/friction.h>
#include <warmjoint/friction_model.h>

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

namespace warmjoint {

/// How well a friction is known; 0: as <warmjoint/compensate.h> guesses it.
struct FrictionDoubt {
  double level_std = 0;   // of the cold level, N.m or N
  double heat_std = 0;    // of the settled heat, N.m or N
  double noise = 0;       // standard deviation of a measured torque about the friction, N.m or N
  double noise_time = 0;  // for which such errors last, s

  template <class A>
  void Serialize(A* a) {
    a->Field("level_std", &level_std, {.unit = "N.m", .bounds = kNotNegative});
    a->Field("heat_std", &heat_std, {.unit = "N.m", .bounds = kNotNegative});
    a->Field("noise", &noise, {.unit = "N.m", .bounds = kNotNegative});
    a->Field("noise_time", &noise_time, {.unit = "s", .bounds = kNotNegative});
  }
};

/// The numbers of a friction as C has them. Copies share the arrays of its maps.
class CompensatorNumbers {
 public:
  /// friction: checked (CheckFriction).
  explicit CompensatorNumbers(const Friction& friction, const FrictionDoubt& doubt = {});

  /// Valid while this or a copy of it lives.
  const wj_friction& numbers() const { return numbers_; }

 private:
  struct Arrays;
  std::shared_ptr<const Arrays> arrays_;
  wj_friction numbers_{};
};

/// What the heat of a compensator comes from: its model, or a measured torque.
enum class HeatSource { model, torque };
inline std::span<const Word<HeatSource>> WordsOf(HeatSource) {
  static constexpr std::array words{Word{"model", HeatSource::model},
                                    Word{"torque", HeatSource::torque}};
  return words;
}

/// Whether a measured torque corrects the level.
enum class LevelCorrection { by_torque, none };
inline std::span<const Word<LevelCorrection>> WordsOf(LevelCorrection) {
  static constexpr std::array words{Word{"by_torque", LevelCorrection::by_torque},
                                    Word{"none", LevelCorrection::none}};
  return words;
}

/// wj_settings, as options and Python have them. Where 0 is no value, it is the default of <warmjoint/compensate.h>.
struct CompensatorSettings {
  double share = 0.9;
  double dead_band = 0;
  double most_speed = 0;
  double longest_gap = 0;
  double contact_time = 0;
  double deviations = 0;
  HeatSource heat = HeatSource::model;
  LevelCorrection correct = LevelCorrection::by_torque;

  template <class A>
  void Serialize(A* a) {
    a->Field("share", &share,
             {.bounds = {.at_least = 0, .at_most = 1}, .meaning = "of the friction"});
    a->Field("dead_band", &dead_band,
             WithDefault("rad/s", "no torque below, all of it from twice that on", kNotNegative));
    a->Field("most_speed", &most_speed,
             WithDefault("rad/s", "a faster velocity counts as this; 0: 1000", kNotNegative));
    a->Field(
        "longest_gap", &longest_gap,
        WithDefault("s", "between two samples, of which the rest is rest; 0: 1 s", kNotNegative));
    a->Field("contact_time", &contact_time,
             WithDefault("s",
                         "over which the residual is averaged; 0: 0.25 s and more with "
                         "noise_time",
                         kNotNegative));
    a->Field("deviations", &deviations,
             WithDefault("", "beyond which a residual is a contact; 0: 3.8", kNotNegative));
    a->Field("heat", &heat, {.meaning = "by the model's friction, or by the measured torque"});
    a->Field("correct", &correct, {.meaning = "the level by the measured torque, or not"});
  }
};

/// A joint with its numbers. Copies go on by themselves.
class Compensator {
 public:
  /// Cold. friction: checked (CheckFriction).
  explicit Compensator(const Friction& friction, const FrictionDoubt& doubt = {},
                       const CompensatorSettings& settings = {});

  wj_joint& joint() { return joint_; }
  const wj_joint& joint() const { return joint_; }

  /// All that its steps have changed, and the inverse: what a copy in another process needs.
  static constexpr size_t kMemory = 21;
  std::array<double, kMemory> Memory() const;
  void Remember(const std::array<double, kMemory>& memory);

 private:
  CompensatorNumbers numbers_;
  wj_joint joint_{};
};

/// What a compensator does along N samples: wj_step's torque, and wj_found. [N] each
struct Compensated {
  Eigen::VectorXd compensation, friction, residual;  // N.m or N
  Eigen::VectorXd energy, std;                       // N.m or N
  Eigen::VectorXd loss;                              // W
  Eigen::VectorXd contact;                           // 1 or 0
};

/// motion: its torque is that of the motor less weight and inertia; none: open loop. The compensator goes on from where it was; where
/// another recording begins, the joint is cold. Where the median sample is longer apart than longest_gap, that is three times as long.
/// reference: [N] velocity that is asked for, rad/s or m/s; empty: the measured one.
Compensated CompensateAlong(Compensator& compensator, const JointTrajectory& motion,
                            const Eigen::VectorXd& reference = {});

}  // namespace warmjoint

// The heat with which a joint begins: given, settled, or left by an earlier recording.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "identification/estimate.h"
#include "models/foundation/bad_input.h"
#include "models/friction/friction_description.h"
#include "models/recording/measurements.h"

namespace warmjoint::inline tools {

/// One stage of warming at the end of a recording.
struct LeftStage {
  double energy = 0;             // E, N.m or N
  double std = 0;                // of that
  double time_constant = 0;      // s
  double time_constant_std = 0;  // s
};

/// What a recording leaves.
struct LeftHeat {
  std::string file;             // that tells of it
  std::optional<double> stamp;  // of its last sample, s; none where that is not known
  std::string unit;             // N.m or N
  std::vector<LeftStage> stages;
};

/// A stage of carried heat as files have it.
struct CarriedStage {
  double value = 0;  // N.m or N
  std::string unit;
  double std = 0;  // of value

  template <class A>
  void Serialize(A* a) {
    a->Field("value", &value, {.needed = kGiveNumber});
    a->Field("unit", &unit, {.needed = "give it as text"});
    a->Field("std", &std, {.needed = kGiveNumber});
  }
};

/// What is left of it at the first sample of the next recording, E(0) = E exp(-pause/tau) for each
/// stage, Eq. (22) without losses.
struct CarriedHeat {
  std::string file;
  double pause = 0;        // s
  std::string pause_from;  // "stamps" or "given"
  std::string unit;
  std::vector<double> energy;  // of each stage, N.m or N
  std::vector<double> std;     // the deviations by E and by tau added up, as if one error made both

  /// The `follows` member of an estimate file: {file, pause, pause_from, energy{value, unit, std}}, and second_energy.
  template <class A>
  void Serialize(A* a) {
    a->Field("file", &file, {.needed = "name it"});
    a->Field("pause", &pause, {.unit = "s", .needed = kGiveNumber});
    a->Field("pause_from", &pause_from, {.needed = "say stamps or given"});
    const char* const keys[] = {"energy", "second_energy"};
    for (size_t i = 0; i < 2; ++i) {
      std::optional<CarriedStage> stage;
      if (i < energy.size()) stage = CarriedStage{energy[i], unit, std[i]};
      a->Field(keys[i], &stage);
      if (!stage || i < energy.size()) continue;
      energy.push_back(stage->value);
      std.push_back(stage->std);
      unit = stage->unit;
    }
  }
};

/// E1 and E2, N.m or N, for `initial` (--initial) and the friction of one file:
///   cold            empty
///   end             `state_end` of that estimate.json: the heat at the end of its recording
///   settled:SPEED   what sliding at SPEED, rad/s or m/s, settles at (SettledEnergy)
/// Throws BadInput for another text, a file without `state_end`, and a speed at which the losses
/// grow for ever.
std::vector<double> InitialEnergy(const std::string& initial, const FrictionDescription& friction,
                                  const std::string& file);

/// An earlier recording of the same joint, --follows and --pause.
struct EarlierRecording {
  std::string file;             // the recording, or its estimate.json; empty: there is none
  std::optional<double> pause;  // s of rest since its end; without one the stamps of both tell it

  bool is_given() const { return !file.empty(); }
};

/// Throws BadInput for a pause without a file, and for several recordings, of which each but the first
/// begins cold.
void CheckEarlier(const EarlierRecording& earlier, size_t recordings);

/// Whether a file is an estimate.json (or another JSON document), not a recording.
bool IsJsonFile(const std::string& file);

/// Of an estimate. Throws BadInput from `file` where it holds no heat that can be trusted.
LeftHeat HeatLeftBy(const Estimate& estimate, const std::string& file);

/// Lets it cool until the next recording begins. pause: s, from the last sample of one to the first
/// of the other, as given; else the stamps of both tell it. Throws BadInput where they cannot, since
/// the next one does not begin behind the end of the one before, or for another unit of the torque.
CarriedHeat CarryOver(const LeftHeat& left, std::optional<double> pause, const Measurements& next);

/// "E(0) is expected at -4.21 +- 0.3 N.m: what day1.csv left, after a pause of 300 s (given) at rest"
std::string Describe(const CarriedHeat& carried);

}  // namespace warmjoint::inline tools

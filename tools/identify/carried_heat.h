// The heat with which a joint begins: given, settled, or left by an earlier recording.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/friction.h>
#include <warmjoint/identify.h>
#include <warmjoint/recording.h>

#include <optional>
#include <string>
#include <vector>

namespace warmjoint {

/// E1 and E2, N.m or N, for `initial` (--initial) and the friction of one file:
///   cold            empty
///   end             `state_end` of that estimate.json: the heat at the end of its recording
///   settled:SPEED   what sliding at SPEED, rad/s or m/s, settles at (SettledEnergy)
/// Throws BadInput for another text, a file without `state_end`, and a speed at which the losses
/// grow for ever.
std::vector<double> InitialEnergies(const std::string& initial, const Friction& friction,
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

/// What an estimate.json says that its log left; nothing where the file is a recording. Throws BadInput.
std::optional<LeftHeat> HeatLeftIn(const std::string& file);

/// "E(0) is expected at -4.21 +- 0.3 N.m: what day1.csv left, after a pause of 300 s (given) at rest"
std::string Describe(const CarriedHeat& carried);

}  // namespace warmjoint

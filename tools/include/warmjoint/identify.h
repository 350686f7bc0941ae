// Friction from a recording: what `warmjoint identify` does.
//
//   IdentifySettings settings;
//   settings.identifier = "energy-ml";  // auto where it is not given
//   settings.options["law"] = "asymmetric";
//   const Estimate estimate = Identify(Prepare(ReadRecordings({{"log.csv"}})), settings);
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/friction.h>
#include <warmjoint/prepared_log.h>

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace warmjoint {

/// What becomes of the numbers of a model that the verdict finds inadequate.
enum class VoidNumbers { withhold, show };
inline std::span<const Word<VoidNumbers>> WordsOf(VoidNumbers) {
  static constexpr std::array words{Word{"withhold", VoidNumbers::withhold},
                                    Word{"show", VoidNumbers::show}};
  return words;
}

/// What is asked of an identification besides its log, each under the name that it has on the command line.
struct IdentifySettings {
  std::string identifier = "auto";
  FittedGravity gravity = FittedGravity::none;
  StartBelief start = StartBelief::cold;
  MotionKind motion = MotionKind::chosen;
  /// Change of the friction by lack of fit, as a share, from which a model is refused.
  double relevance = kDefaultRelevance;
  std::map<std::string, std::string> options;  // of the identifier, as --set
  VoidNumbers void_numbers = VoidNumbers::withhold;
  bool follows = false;  // an earlier recording, whose heat is given once it is read

  template <class A>
  void Serialize(A* a) {
    a->Field("identifier", &identifier);
    a->Field("gravity", &gravity);
    a->Field("start", &start);
    a->Field("motion", &motion);
    a->Field("relevance", &relevance, {.bounds = {.above = 0, .at_most = 1}});
    a->Field("options", &options);
    a->Field("void_numbers", &void_numbers);
  }
};

/// Samples for figures on unseen data: a share of the recording's end, 0 for none, or another one.
struct HoldOutSource {
  double fraction = 0.3;
  std::optional<PreparedLog> other{};
};

/// Throws BadInput for a share that is not at least 0 and below 1.
HoldOutSource HoldOutShare(double fraction);

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

/// Of an estimate. Throws BadInput from `file` where it holds no heat that can be trusted.
LeftHeat HeatLeftBy(const Estimate& estimate, const std::string& file);

/// Lets it cool until the next recording begins. pause: s, from the last sample of one to the first
/// of the other, as given; else the stamps of both tell it. Throws BadInput where they cannot, since
/// the next one does not begin behind the end of the one before, or for another unit of the torque.
CarriedHeat CarryOver(const LeftHeat& left, std::optional<double> pause, const Measurements& next);

/// Fits, judges and reports. The verdict is the estimate's status, with a message and data (diagnostics); mathematics that
/// fails does not throw. follows: the heat that an earlier recording left. watch: is told what is being tried; what it throws
/// ends the fit. Throws BadInput for names, options and numbers that cannot be used. Several threads may identify at once.
Estimate Identify(const PreparedLog& log, IdentifySettings settings = {},
                  const HoldOutSource& holdout = {}, const std::optional<CarriedHeat>& follows = {},
                  const std::function<void(const std::string& words)>& watch = {});

/// The friction in `file` for the joints that `joint` names, with the heat `initial` at the start: cold, end (of the estimate's
/// recording) or settled:SPEED (rad/s or m/s). Adds to `warnings` what the estimate's own verdict says against its friction:
/// identify --force writes such ones. Throws BadInput, also for an estimate without friction.
FrictionForJoint ReadFrictionForJoint(const std::string& joint, const std::string& file,
                                      const std::string& initial,
                                      std::vector<std::string>& warnings);

}  // namespace warmjoint

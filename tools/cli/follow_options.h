// --follows and --pause, shared by the subcommands that begin with the heat of an earlier recording.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "tools/actions/carried_heat.h"
#include "tools/actions/identify_recording.h"
#include "tools/actions/predict_recording.h"
#include "tools/actions/recording_source.h"

namespace warmjoint::inline tools {

struct FollowArguments {
  std::string file;
  std::optional<double> pause;  // s

  bool are_given() const { return !file.empty(); }
};

/// Adds both.
void AddFollowOptions(CLI::App& parser, FollowArguments& arguments);

/// Throws BadInput for a pause without a file, and for several recordings, of which each but the first
/// begins cold.
void CheckFollow(const FollowArguments& arguments, const RecordingArguments& recording);

/// The heat with which `next` begins. Of an estimate.json its state_end; of a recording that of its own
/// estimate by the same settings, from a cold start. Throws BadInput.
CarriedHeat HeatBefore(const FollowArguments& arguments, const RecordingArguments& recording,
                       const IdentifySettings& settings, const Measurements& next);

/// The same for a model that is there already: of a recording what the model makes of its motion, from a
/// cold start; the model's time constants let it cool.
CarriedHeat HeatBefore(const FollowArguments& arguments, const RecordingArguments& recording,
                       const StoredModel& stored, const Measurements& next);

}  // namespace warmjoint::inline tools

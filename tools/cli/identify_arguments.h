// What the command line of `identify` asks for.
#pragma once

#include <string>
#include <vector>

#include "tools/actions/identify_recording.h"
#include "tools/cli/follow_options.h"
#include "tools/cli/recording_options.h"
#include "tools/suite/sandbox.h"

namespace warmjoint::inline tools {

struct IdentifyArguments {
  RecordingArguments recording;
  IdentifySettings settings;
  FollowArguments follow;
  std::vector<std::string> identifiers{IdentifySettings{}.identifier};
  std::string holdout = "0.3";
  std::vector<std::string> set;
  std::string output;
  std::string mjcf;
  std::string plot;
  std::string format = "text";
  bool explain = false;
  bool force = false;
  Confinement confinement = Confinement::sandbox;  // of a command
};

/// The settings with --set and --force, of one identifier.
IdentifySettings SettingsOf(const IdentifyArguments& arguments, const std::string& identifier);

}  // namespace warmjoint::inline tools

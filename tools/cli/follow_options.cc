#include "tools/cli/follow_options.h"

#include "identification/estimate_from_json.h"
#include "identification/preparation/moving_view.h"
#include "models/foundation/read_json.h"

namespace warmjoint::inline tools {
namespace {

PreparedLog ReadEarlier(const FollowArguments& arguments, const RecordingArguments& recording) {
  RecordingArguments earlier = recording;
  earlier.recordings = {arguments.file};
  return ReadAndPrepare(earlier);
}

Estimate ReadEstimate(const std::string& file) {
  return EstimateFromJson(ReadJsonFile(file), {file});
}

/// The heat at the end of a log, as a model has it that knows no errors.
LeftHeat HeatAtEnd(const StoredModel& stored, const PreparedLog& log, const std::string& file) {
  // the samples that such a model predicts: all that move, where it has an inertia
  const LogView& view = stored.model.inertia ? MovingView(log) : log.steady();
  const Measurements& m = view.measurements;
  const FrictionState end = PredictTorque(stored.model, m, view.selection, {}).friction.end;
  // its heat at the last sample, which is no estimate and has no errors
  LeftHeat left{file, m.time[m.size() - 1], m.torque_unit, {}};
  left.stages.push_back({end.energy, 0, stored.model.friction.thermal->time_constant, 0});
  // a second stage has its own heat and cools by its own time constant
  if (stored.model.friction.second_thermal) {
    left.stages.push_back(
        {end.second_energy, 0, stored.model.friction.second_thermal->time_constant, 0});
  }
  return left;
}

}  // namespace

void AddFollowOptions(CLI::App& parser, FollowArguments& arguments) {
  parser
      .add_option("--follows", arguments.file,
                  "recording before this one, or its estimate.json: the heat that it left is "
                  "there at the start, less what cooled in the pause between")
      ->type_name("FILE");
  parser
      .add_option("--pause", arguments.pause,
                  "s of rest between the end of --follows and the start of the recording; where "
                  "their stamps share a clock, these tell it")
      ->type_name("SECONDS");
}

void CheckFollow(const FollowArguments& arguments, const RecordingArguments& recording) {
  // each option alone makes no sense
  if (arguments.pause && !arguments.are_given()) {
    Refuse({"--pause"}, "is the time since an earlier recording; name that with --follows");
  }
  if (arguments.are_given() && recording.recordings.size() > 1) {
    Refuse({"--follows"}, "is for one recording, and {} are given, which begin cold each",
           recording.recordings.size());
  }
}

CarriedHeat HeatBefore(const FollowArguments& arguments, const RecordingArguments& recording,
                       const IdentifySettings& settings, const Measurements& next) {
  const std::string& file = arguments.file;
  // an estimate file tells the heat that its log left
  if (IsJsonFile(file))
    return CarryOver(HeatLeftBy(ReadEstimate(file), file), arguments.pause, next);

  // a recording is identified first, from a cold start and without held-out figures
  const PreparedLog log = ReadEarlier(arguments, recording);
  const IdentifyTask task = CheckSettings(settings, JointOf(recording));
  const Estimate estimate = IdentifyLog(task, log, {0, std::nullopt}).estimate;
  return CarryOver(HeatLeftBy(estimate, file), arguments.pause, next);
}

CarriedHeat HeatBefore(const FollowArguments& arguments, const RecordingArguments& recording,
                       const StoredModel& stored, const Measurements& next) {
  const std::string& file = arguments.file;
  // heat needs a model that warms
  if (!stored.model.friction.thermal) {
    Refuse({"--follows"}, "is for a friction that warms, and the estimate knows no warming");
  }
  if (IsJsonFile(file))
    return CarryOver(HeatLeftBy(ReadEstimate(file), file), arguments.pause, next);
  // of a recording the model tells the heat by its motion
  return CarryOver(HeatAtEnd(stored, ReadEarlier(arguments, recording), file), arguments.pause,
                   next);
}

}  // namespace warmjoint::inline tools

#include "tools/cli/recording_options.h"

namespace warmjoint::inline tools {

void AddRecordingOptions(CLI::App& parser, RecordingArguments& arguments) {
  parser
      .add_option("RECORDING", arguments.recordings,
                  "CSV or HDF5 file; several of one joint, each from a cold start")
      ->required();
  AddLayoutOptions(parser, arguments);
}

void AddLayoutOptions(CLI::App& parser, RecordingArguments& arguments) {
  parser.add_option("--map", arguments.map, "columns of the file, as torque=force_N,time=t_s")
      ->delimiter(',')
      ->take_all();
  parser.add_option("--unit", arguments.unit, "units of the file, as position=deg,time=ms")
      ->delimiter(',')
      ->take_all();
  parser
      .add_option("--scale", arguments.scale,
                  "factors on the columns of the file, as torque=-1,velocity=0.5")
      ->delimiter(',')
      ->take_all();
  parser.add_option(
      "--wrap", arguments.wrap,
      "range after which the position starts again, in its unit; a turn is undone anyway");
  parser.add_option("--joint", arguments.joint, "rotary or linear")
      ->check(CLI::IsMember({"rotary", "linear"}))
      ->capture_default_str();
  parser.add_option("--gear", arguments.gear, "motor turns for each joint turn")
      ->capture_default_str();
}

void AddHoldOptions(CLI::App& parser, HoldOptions& holds) {
  parser.add_option("--trim", holds.trim, "s to leave out at each end of a constant speed")
      ->check(CLI::NonNegativeNumber);
  parser
      .add_option("--shortest-hold", holds.shortest,
                  "s; a constant speed that lasts less is left out")
      ->check(CLI::NonNegativeNumber);
}

}  // namespace warmjoint::inline tools

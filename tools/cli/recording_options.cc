#include "tools/cli/recording_options.h"

#include <limits>

#include "tools/cli/take_project.h"
#include "tools/cli/typed_options.h"

namespace warmjoint::inline tools {

void AddRecordingOptions(CLI::App& parser, RecordingArguments& arguments) {
  parser
      .add_option(
          "RECORDING", arguments.recordings,
          "CSV or HDF5 file, or - for a CSV on standard input; several of one joint, each from a "
          "cold start")
      ->type_name("RECORDING")
      ->required();
  AddLayoutOptions(parser, arguments);
}

void AddLayoutOptions(CLI::App& parser, RecordingArguments& arguments) {
  // columns: their names, units and factors
  parser.add_option("--map", arguments.map, "columns of the file, as torque=force_N,time=t_s")
      ->type_name("COLUMN=NAME")
      ->delimiter(',')
      ->take_all();
  parser.add_option("--unit", arguments.unit, "units of the file, as position=deg,time=ms")
      ->type_name("COLUMN=UNIT")
      ->delimiter(',')
      ->take_all();
  parser
      .add_option("--scale", arguments.scale,
                  "factors on the columns of the file, as torque=-1,velocity=0.5")
      ->type_name("COLUMN=NUMBER")
      ->delimiter(',')
      ->take_all();

  // sensors that wrap, and a temperature that is set beside the answer
  parser
      .add_option(
          "--wrap", arguments.wrap,
          "range after which the position starts again, in its unit; a turn is undone anyway")
      ->type_name("NUMBER");
  parser
      .add_option_function<std::string>(
          "--temperature",
          [&arguments](const std::string& name) { arguments.map.push_back("temperature=" + name); },
          "column with a temperature, as --map temperature=NAME: the answer is set beside it; one "
          "whose name ends in degC, or as temp_K, is found")
      ->type_name("NAME");

  // the joint and its drive
  AddChoice(
      parser, "--joint", arguments.joint, {"rotary", "linear"}, "kind of the joint",
      {{"prismatic", "linear"}, {"revolute", "rotary"}, {"hinge", "rotary"}, {"slide", "linear"}});
  parser.add_option("--gear", arguments.gear, "motor turns for each joint turn")
      ->type_name("NUMBER")
      ->capture_default_str();
  parser
      .add_option(
          "--torque-constant", arguments.torque_constant,
          "torque of the joint for each ampere, N.m/A or N/A with the gear in it; makes N.m "
          "or N of --unit torque=A")
      ->type_name("NUMBER");
  AddProjectOption(parser);
}

void AddHoldOptions(CLI::App& parser, HoldOptions& holds) {
  // both in seconds, at least 0
  const Bounds seconds{0, std::numeric_limits<double>::infinity(), "of 0 or more, s"};
  AddNumber(parser, "--trim", holds.trim, seconds,
            "s to leave out at each end of a constant speed");
  AddNumber(parser, "--shortest-hold", holds.shortest, seconds,
            "s; a constant speed that lasts less is left out");
}

}  // namespace warmjoint::inline tools

// warmjoint identify-robot ROBOT LOG...: the friction of all joints from a description and logs.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <warmjoint/identify_robot.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "identification/robot/robot_estimate.h"
#include "models/foundation/atomic_file.h"
#include "models/foundation/description_text.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"
#include "models/robots/robot_folder.h"
#include "tools/actions/outputs.h"
#include "tools/cli/backend.h"
#include "tools/cli/command.h"
#include "tools/cli/robot_table.h"
#include "tools/cli/typed_options.h"
#include "tools/robot/robot_friction.h"
#include "tools/shown/estimate_data.h"
#include "tools/terminal/progress_line.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

struct RobotArguments {
  std::string robot;
  RecordingSource log;
  RobotSettings settings;
  std::string output, mjcf, plot;
  std::string format = "text";
};

/// The parts of a list with commas.
std::vector<std::string> SplitAtCommas(const std::string& list) {
  std::vector<std::string> parts(1);
  for (const char c : list) {
    if (c == ',') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// Calls take(key, value) for each KEY=VALUE of lists with commas; without a sign the key is empty.
template <typename Take>
void AddPairs(CLI::App& parser, const char* name, const char* form, const char* description,
              const Take& take) {
  const auto read = [name, take](const std::vector<std::string>& lists) {
    for (const std::string& list : lists) {
      for (const std::string& pair : SplitAtCommas(list)) {
        const std::size_t equals = pair.find('=');
        const bool has_key = equals != std::string::npos;
        take(name, has_key ? pair.substr(0, equals) : std::string(),
             has_key ? pair.substr(equals + 1) : pair);
      }
    }
  };
  parser.add_option_function<std::vector<std::string>>(name, read, description)
      ->type_name(form)
      ->take_all();
}

double NumberIn(const char* option, const std::string& key, const std::string& text) {
  const auto number = ParseFinite(text);
  if (!number) Refuse({option}, "{}='{}' is no finite number", Excerpt(key), Excerpt(text));
  return *number;
}

/// --tool mass=..,com=X,Y,Z or unknown.
RobotTool ReadTool(const std::string& text) {
  RobotTool tool;
  if (text == "unknown") return {.known = ToolKnown::unknown};
  tool.known = ToolKnown::given;
  bool has_mass = false;
  std::size_t axis = 3;
  for (const std::string& part : SplitAtCommas(text)) {
    if (part.starts_with("mass=")) {
      tool.mass = NumberIn("--tool", "mass", part.substr(5));
      has_mass = true;
      continue;
    }
    const bool begins = part.starts_with("com=");
    if (begins) axis = 0;
    if (axis > 2)
      Refuse({"--tool"}, "'{}' is none of mass=KG, com=X,Y,Z and unknown", Excerpt(part));
    tool.centre[axis++] = NumberIn("--tool", "com", begins ? part.substr(4) : part);
  }
  if (!has_mass) Refuse({"--tool"}, "'{}' gives no mass: --tool mass=KG,com=X,Y,Z", Excerpt(text));
  if (axis < 3) {
    Refuse({"--tool"}, "'{}' gives {} of the three numbers of com: --tool mass=KG,com=X,Y,Z",
           Excerpt(text), axis);
  }
  return tool;
}

/// --inertials given, given:SHARE or exact.
double ReadInertials(const std::string& text) {
  if (text == "exact") return 0;
  if (text == "given") return RobotSettings{}.inertials;
  const auto share = text.starts_with("given:") ? ParseNumber(text.substr(6)) : std::nullopt;
  if (share && *share > 0 && *share <= 10) return *share;
  Refuse({"--inertials"}, "is '{}'; it must be given, given:SHARE with a share above 0, or exact",
         Excerpt(text));
}

void AddReadingOptions(CLI::App& parser, RobotArguments& arguments) {
  ReadSettings& read = arguments.log.read;
  AddPairs(
      parser, "--map", "COLUMN=PATTERN",
      "columns of the file, as 'position=q_{j},torque=tau_{j},time=t': {j} counts from 0, {1..6} "
      "and {a|b|c} stand for each joint in order, {name} for its name",
      [&read](const char* option, const std::string& key, const std::string& value) {
        if (key != "position" && key != "torque" && key != "time") {
          Refuse({option}, "'{}' is none of time, position and torque", Excerpt(key));
        }
        read.map[key] = value;
      });
  AddPairs(parser, "--unit", "COLUMN=UNIT", "units in the file, as position=deg,torque=A",
           [&read](const char* option, const std::string& key, const std::string& value) {
             if (key != "position" && key != "torque" && key != "time") {
               Refuse({option}, "'{}' is none of time, position and torque", Excerpt(key));
             }
             read.unit[key] = value;
           });
  AddPairs(parser, "--scale", "COLUMN=NUMBER",
           "factors on columns: torque=-1, or of one joint, J4.torque=-1,J4.position=-1",
           [&arguments](const char* option, const std::string& key, const std::string& value) {
             const std::size_t dot = key.rfind('.');
             const std::string joint = dot == std::string::npos ? "" : key.substr(0, dot);
             const std::string column = dot == std::string::npos ? key : key.substr(dot + 1);
             if (column != "torque" && column != "position") {
               Refuse({option},
                      "'{}' is neither torque nor position, nor JOINT.torque or JOINT.position",
                      Excerpt(key));
             }
             RobotSettings& settings = arguments.settings;
             (column == "torque" ? settings.torque_scale : settings.position_scale)[joint] =
                 NumberIn(option, key, value);
           });
  AddPairs(parser, "--columns", "NAMES", "names of all columns of a text file without a header",
           [&read](const char*, const std::string&, const std::string& value) {
             read.columns.push_back(value);
           });
  AddNumber(parser, "--rate", read.rate, {0, kInfinity, "of 0 or more, Hz"},
            "rate of a log without time, Hz");
  AddPairs(parser, "--joints", "NAMES",
           "joints of the robot that the log holds, in the order of its columns",
           [&arguments](const char*, const std::string&, const std::string& value) {
             arguments.settings.joints.push_back(value);
           });
  AddPairs(parser, "--torque-constant", "JOINT=NUMBER",
           "N.m/A at the joint, for all or one joint: .1 or J4=.1",
           [&arguments](const char* option, const std::string& key, const std::string& value) {
             arguments.settings.torque_constant[key] = NumberIn(option, key, value);
           });
}

void AddRobotOptions(CLI::App& parser, RobotArguments& arguments) {
  RobotSettings& settings = arguments.settings;
  AddPairs(parser, "--gear", "NUMBER",
           "motor turns for each turn of the joint, whose ripple is fitted: 101 or J4=101",
           [&settings](const char* option, const std::string& key, const std::string& value) {
             settings.gear[key] = NumberIn(option, key, value);
           });
  parser
      .add_option_function<std::string>(
          "--inertials",
          [&settings](const std::string& text) { settings.inertials = ReadInertials(text); },
          "how wrong masses, their places and inertias may be: given (a tenth), given:SHARE or "
          "exact")
      ->type_name("WORD");
  parser
      .add_option_function<std::string>(
          "--tool", [&settings](const std::string& text) { settings.tool = ReadTool(text); },
          "a load at the last link that the description lacks: mass=KG,com=X,Y,Z in its axes, or "
          "unknown")
      ->type_name("TEXT");
  AddValue(parser, "--coupling", "TEXT", settings.coupling,
           "a motor that turns with several joints, as J6=J5+J6")
      ->take_all();
  AddNumber(parser, "--cutoff", settings.cutoff, {.1, 1e4, "of .1 or more, Hz"},
            "low-pass of positions, torques and all that is fitted, Hz");
  AddNumber(parser, "--holdout", settings.holdout, {0, .9, "from 0 to .9"},
            "share of the log's end for figures on unseen data; 0: none");
}

/// A picture a joint, JOINT.png in a folder.
void DrawJoints(const Backend& backend, const RobotEstimate& answer, const std::string& folder,
                Outputs& outputs) {
  DrawRequest request;
  request.sources.push_back(
      {{"kind", "robot"}, {"place", folder}, {"joints", shown::RobotFacts(answer, request.data)}});
  for (DrawnFile& file : backend.Draw(std::move(request), {}).files) {
    outputs.Add(std::filesystem::path(folder) / file.name, std::move(file.bytes));
  }
}

ExitStatus IdentifyRobotCommand(const RobotArguments& arguments) {
  // outputs that are inputs too, or cannot be written, before any time is spent
  const std::filesystem::path robot = FindRobot(arguments.robot, "ROBOT");
  const std::vector<std::filesystem::path> targets{arguments.output, arguments.mjcf};
  std::vector<std::filesystem::path> inputs = FilesOfDescription(robot);
  inputs.insert(inputs.end(), arguments.log.files.begin(), arguments.log.files.end());
  Outputs outputs(targets, inputs);
  if (std::filesystem::exists(arguments.plot) && !std::filesystem::is_directory(arguments.plot)) {
    Refuse({"--plot"}, "'{}' is a file; give a folder", Excerpt(arguments.plot));
  }

  const auto backend =
      arguments.plot.empty() ? std::nullopt : std::optional<Backend>(std::in_place);
  Activity activity("reading");
  const RobotEstimate answer = IdentifyRobot(robot, arguments.log, arguments.settings,
                                             [&](const std::string& words) { activity.Is(words); });
  const std::string text = RobotEstimateToJson(answer, arguments.output);
  outputs.Add(arguments.output, text);
  std::vector<std::string> notices = answer.notices;
  const bool has_friction = std::ranges::any_of(answer.joints, &RobotJointEstimate::HasFriction);
  if (!arguments.mjcf.empty() && !has_friction) {
    notices.push_back(arguments.mjcf +
                      " is not written: no joint has a friction that MuJoCo can use");
  } else if (!arguments.mjcf.empty()) {
    activity.Is("making " + arguments.mjcf);
    AttachedText warm = WarmModel(robot, answer, arguments.mjcf);
    const std::vector<std::string>& said = warm.attached.notices;
    notices.insert(notices.end(), said.begin(), said.end());
    outputs.Add(arguments.mjcf, std::move(warm.xml));
  }
  if (backend) {
    activity.Is("drawing");
    DrawJoints(*backend, answer, arguments.plot, outputs);
  }
  outputs.Write();
  std::FILE* const words = WordsBeside(targets);
  activity.Aside([&] {
    for (const std::string& notice : notices) SayNotice("notice: {}\n", notice);
    if (arguments.format != "json") {
      SayText(words, RobotToText(answer, PageOf(words)));
    } else if (!IsStandardOutput(arguments.output)) {
      fmt::print(words, "{}", text);
    }
  });
  const bool any = std::ranges::any_of(answer.joints, [](const RobotJointEstimate& one) {
    return one.estimate.status == Status::ok;
  });
  return any ? ExitStatus::done : ExitStatus::nothing_trustworthy;
}

}  // namespace

Command AddIdentifyRobotCommand(CLI::App& program) {
  auto arguments = std::make_shared<RobotArguments>();
  CLI::App* parser = program.add_subcommand(
      "identify-robot", "Friction of all joints from a robot's description and logs");
  AddValue(*parser, "ROBOT", "ROBOT", arguments->robot,
           "MJCF or URDF file, or one of: warmjoint list robots")
      ->required();
  AddValue(
      *parser, "LOG", "LOG", arguments->log.files,
      "table of text, HDF5 or MATLAB file with columns for each joint; several, each from a cold "
      "start")
      ->required();
  GiveExample(*parser,
              "warmjoint identify-robot robot.urdf log.csv --map "
              "'position=q_{j},torque=tau_{j},time=t' -o robot.json");
  AddValue(*parser, "-o,--output", "FILE", arguments->output, "robot.json; -: standard output");
  AddValue(*parser, "--mjcf", "FILE", arguments->mjcf,
           "the robot with the frictions that are known in N.m or N, MJCF");
  AddValue(*parser, "--plot", "DIR", arguments->plot, "folder for a picture of each joint");
  AddChoice(*parser, "--format", arguments->format, {"text", "json"},
            "of what is printed; json: as in robot.json");
  BeginGroup(*parser, "How the log is read");
  AddReadingOptions(*parser, *arguments);
  BeginGroup(*parser, "What is known of the robot");
  AddRobotOptions(*parser, *arguments);
  return {parser, [arguments] { return IdentifyRobotCommand(*arguments); }};
}

}  // namespace warmjoint

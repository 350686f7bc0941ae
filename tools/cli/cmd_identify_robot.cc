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
#include "models/robots/robot_folder.h"
#include "tools/actions/outputs.h"
#include "tools/cli/backend.h"
#include "tools/cli/command.h"
#include "tools/cli/robot_options.h"
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

/// A picture a joint, JOINT.png in a folder.
void DrawJoints(const Backend& backend, const RobotEstimate& answer, const std::string& folder,
                Outputs& outputs) {
  DrawRequest request;
  request.sources.push_back({{"kind", "robot"},
                             {"place", folder},
                             {"joints", shown::RobotFacts(answer, request.data)},
                             {"robot", RobotEstimateToTree(answer)}});
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
  AddRobotReading(*parser, arguments->log.read, arguments->settings);
  BeginGroup(*parser, "What is known of the robot");
  AddFittedRobot(*parser, arguments->settings);
  AddKnownRobot(*parser, arguments->settings);
  AddFields(*parser, arguments->settings.fields);
  AddNumber(*parser, "--holdout", arguments->settings.holdout, {0, .9, "from 0 to .9"},
            "share of the log's end for figures on unseen data; 0: none");
  return {parser, [arguments] { return IdentifyRobotCommand(*arguments); }};
}

}  // namespace warmjoint

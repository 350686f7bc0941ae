// warmjoint attach MODEL: friction onto the joints of any robot.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "models/foundation/excerpt.h"
#include "models/foundation/read_json.h"
#include "models/robots/robot_folder.h"
#include "sim/model/attach.h"
#include "tools/cli/command.h"

namespace warmjoint::inline tools {
namespace {

struct AttachArguments {
  std::string model;
  std::vector<std::string> joints;
  std::string output;
};

/// Tells of an estimate that its own verdict voids: identify --force writes such ones.
void WarnOfVoid(const std::string& path) {
  const nlohmann::json object = ReadJsonFile(path);
  if (!object.contains("status") || object["status"] == "ok") return;
  fmt::print(stderr, "warning: {} is {}: its friction is void, and so is that of the model\n", path,
             object["status"].dump());
}

/// NAME=FILE of --joint.
FrictionForJoint ReadJoint(const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == text.size()) {
    Refuse({"--joint"}, "is '{}'; it must be NAME=FILE, as elbow=estimate.json", Excerpt(text));
  }
  FrictionForJoint joint{text.substr(0, equals), ReadFrictionFile(text.substr(equals + 1))};
  WarnOfVoid(text.substr(equals + 1));
  return joint;
}

ExitStatus Attach(const AttachArguments& arguments) {
  std::vector<FrictionForJoint> frictions;
  for (const std::string& text : arguments.joints) frictions.push_back(ReadJoint(text));
  const auto notices =
      AttachFriction(FindRobot(arguments.model, "MODEL"), frictions, arguments.output);
  for (const std::string& notice : notices) fmt::print(stderr, "notice: {}\n", notice);
  fmt::print("{}: friction on {} of its joints; load it with libwarmjoint_friction.so\n",
             arguments.output, frictions.size());
  return ExitStatus::done;
}

}  // namespace

Command AddAttachCommand(CLI::App& program) {
  auto arguments = std::make_shared<AttachArguments>();
  CLI::App* parser = program.add_subcommand("attach", "Friction onto the joints of any robot");
  parser
      ->add_option("MODEL", arguments->model, "MJCF or URDF file, or one of: warmjoint list robots")
      ->required();
  parser
      ->add_option("--joint", arguments->joints,
                   "NAME=FILE: estimate.json or another friction file for that joint")
      ->required()
      ->take_all();
  parser->add_option("-o,--output", arguments->output, "the model with friction, MJCF")->required();
  return {parser, [arguments] { return Attach(*arguments); }};
}

}  // namespace warmjoint::inline tools

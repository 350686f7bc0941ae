// warmjoint attach MODEL: friction onto the joints of any robot.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"
#include "models/foundation/read_json.h"
#include "models/robots/robot_folder.h"
#include "sim/model/attach.h"
#include "tools/cli/command.h"
#include "tools/cli/initial_energy.h"
#include "tools/cli/outputs.h"

namespace warmjoint::inline tools {
namespace {

const std::map<std::string, mjtIntegrator> kIntegrators{{"Euler", mjINT_EULER},
                                                        {"RK4", mjINT_RK4},
                                                        {"implicit", mjINT_IMPLICIT},
                                                        {"implicitfast", mjINT_IMPLICITFAST},
                                                        {"discrete", mjINT_DISCRETE}};

struct AttachArguments {
  std::string model;
  std::vector<std::string> joints;
  std::string form = "actuator";
  std::string initial = "cold";
  std::vector<std::string> armatures;
  std::string integrator;
  std::optional<double> timestep;
  std::vector<std::string> packages;
  std::string output;
};

/// KEY=VALUE of an option that may be given several times.
std::pair<std::string, std::string> ReadPair(const std::string& text, const char* option,
                                             const char* form) {
  const size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == text.size()) {
    Refuse({option}, "is '{}'; it must be {}", Excerpt(text), form);
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

/// Refuses an estimate without friction, and tells of one that its own verdict voids: identify
/// --force writes such ones.
void CheckVerdict(const std::string& path) {
  const nlohmann::json object = ReadJsonFile(path);
  if (!object.is_object() || !object.contains("status") || object["status"] == "ok") return;
  const std::string status = object["status"].dump();
  if (object.contains("friction") && object["friction"].is_null()) {
    Refuse({path}, "is {} and holds no friction; identify again with --force to use it anyway",
           status);
  }
  fmt::print(stderr, "warning: {} is {}: its friction is void, and so is that of the model\n", path,
             status);
}

/// NAME=FILE of --joint.
FrictionForJoint ReadJoint(const std::string& text, const std::string& initial) {
  const auto [joint, file] =
      ReadPair(text, "--joint", "NAME=FILE or PATTERN=FILE, as elbow=estimate.json");
  CheckVerdict(file);
  FrictionForJoint friction{joint, ReadFrictionFile(file)};
  friction.initial_energy = InitialEnergy(initial, friction.friction, file);
  return friction;
}

/// NAME=VALUE of --armature.
ArmatureForJoints ReadArmature(const std::string& text) {
  const auto [joints, value] = ReadPair(text, "--armature", "NAME=VALUE or PATTERN=VALUE");
  const auto armature = ParseNumber(value);
  if (!armature || !std::isfinite(*armature) || *armature < 0) {
    Refuse({"--armature"}, "of '{}' is '{}'; it must be a number of 0 or more, kg.m^2 or kg",
           Excerpt(joints), Excerpt(value));
  }
  return {joints, *armature};
}

AttachOptions ReadOptions(const AttachArguments& arguments) {
  AttachOptions options;
  if (arguments.form == "passive") options.form = FrictionForm::passive;
  for (const std::string& text : arguments.armatures) {
    options.armatures.push_back(ReadArmature(text));
  }
  if (!arguments.integrator.empty()) options.integrator = kIntegrators.at(arguments.integrator);
  options.timestep = arguments.timestep;
  if (options.timestep && !(std::isfinite(*options.timestep) && *options.timestep > 0)) {
    Refuse({"--timestep"}, "is {}; it must be above 0, s", *options.timestep);
  }
  for (const std::string& text : arguments.packages) {
    const auto [name, folder] = ReadPair(text, "--package", "NAME=FOLDER");
    if (!std::filesystem::is_directory(folder)) {
      Refuse({"--package"}, "of '{}' is '{}', which is no folder", Excerpt(name), Excerpt(folder));
    }
    options.packages[name] = folder;
  }
  return options;
}

ExitStatus Attach(const AttachArguments& arguments) {
  const AttachOptions options = ReadOptions(arguments);
  std::vector<FrictionForJoint> frictions;
  const std::filesystem::path model = FindRobot(arguments.model, "MODEL");
  std::vector<std::filesystem::path> inputs{model};
  for (const std::string& text : arguments.joints) {
    frictions.push_back(ReadJoint(text, arguments.initial));
    inputs.emplace_back(text.substr(text.find('=') + 1));
  }
  KeepApart({arguments.output}, inputs);
  const Attached attached = AttachFriction(model, frictions, arguments.output, options);
  for (const std::string& notice : attached.notices) fmt::print(stderr, "notice: {}\n", notice);
  fmt::print(
      WordsBeside({arguments.output}),
      "{}: friction on {} of its joints; load it with libwarmjoint_friction.so in MuJoCo {}\n",
      arguments.output, attached.joints.size(), mj_versionString());
  return ExitStatus::done;
}

void AddModelOptions(CLI::App& parser, AttachArguments& arguments) {
  parser
      .add_option("--armature", arguments.armatures,
                  "NAME=VALUE or PATTERN=VALUE: armature of these joints, kg.m^2 or kg")
      ->take_all();
  std::vector<std::string> integrators;
  for (const auto& [name, unused] : kIntegrators) integrators.push_back(name);
  parser.add_option("--integrator", arguments.integrator, "integrator of the result")
      ->check(CLI::IsMember(integrators));
  parser.add_option("--timestep", arguments.timestep, "step of the result, s");
  parser
      .add_option("--package", arguments.packages,
                  "NAME=FOLDER: where package://NAME of a URDF's meshes lies")
      ->take_all();
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
                   "NAME=FILE or PATTERN=FILE (a regular expression): estimate.json or another "
                   "friction file for these joints")
      ->required()
      ->take_all();
  parser->add_option("--as", arguments->form, "actuator or passive: how friction acts")
      ->check(CLI::IsMember({"actuator", "passive"}))
      ->capture_default_str();
  parser
      ->add_option("--initial", arguments->initial,
                   "heat at the start: cold, end (of the estimate's recording) or settled:SPEED")
      ->capture_default_str();
  AddModelOptions(*parser, *arguments);
  parser->add_option("-o,--output", arguments->output, "the model with friction, MJCF")->required();
  return {parser, [arguments] { return Attach(*arguments); }};
}

}  // namespace warmjoint::inline tools

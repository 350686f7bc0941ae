// warmjoint attach MODEL: friction onto the joints of any robot.
#include <fmt/format.h>

#include <memory>
#include <utility>

#include "models/foundation/bad_input.h"
#include "models/foundation/description_text.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/node.h"
#include "models/foundation/parse_number.h"
#include "models/robots/robot_folder.h"
#include "sim/model/attach_text.h"
#include "tools/actions/outputs.h"
#include "tools/cli/command.h"
#include "tools/cli/typed_options.h"
#include "tools/identify/carried_heat.h"
#include "tools/robot/robot_friction.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

struct AttachArguments {
  std::string model;
  std::vector<std::string> joints;
  std::string robot;                   // robot.json
  std::vector<std::string> constants;  // of its joints
  std::string initial = "cold";
  AttachOptions options;
  std::vector<std::string> armatures;
  std::vector<std::string> packages;
  std::string output;
};

/// KEY=VALUE of an option that may be given several times.
std::pair<std::string, std::string> ReadPair(const std::string& text, const char* option,
                                             const char* form) {
  // both sides must be there; the value may hold further equals signs
  const size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == text.size()) {
    Refuse({option}, "is '{}'; it must be {}", Excerpt(text), form);
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

/// NAME=FILE of --joint.
FrictionForJoint ReadJoint(const std::string& text, const std::string& initial,
                           std::vector<std::string>& warnings) {
  const auto [joint, file] =
      ReadPair(text, "--joint", "NAME=FILE or PATTERN=FILE, as elbow=estimate.json");
  return ReadFrictionForJoint(joint, file, initial, warnings);
}

/// The kind of joint that an estimate.json is of; nothing where the file does not tell.
std::optional<JointKind> KindOfFile(const std::string& file) {
  std::map<std::string, std::string> units;
  const auto parameters = ReadJsonNode(file).Find("parameters");
  if (!parameters || !parameters->IsMap()) return std::nullopt;
  for (const std::string& name : parameters->Keys()) {
    const auto one = parameters->Find(name);
    const auto unit = one && one->IsMap() ? one->Find("unit") : std::nullopt;
    if (unit) units[name] = unit->Text();
  }
  return KindOfUnits(units);
}

/// The frictions of a robot's answer, in N.m or N by [NAME=]VALUE of --torque-constant.
std::vector<FrictionForJoint> ReadRobot(const AttachArguments& arguments,
                                        std::vector<std::string>& warnings) {
  NumberOfJoints constants;
  for (const std::string& text : arguments.constants) {
    const std::size_t equals = text.find('=');
    const std::string joint = equals == std::string::npos ? "" : text.substr(0, equals);
    const auto value = ParseFinite(equals == std::string::npos ? text : text.substr(equals + 1));
    if (!value) Refuse({"--torque-constant"}, "'{}' is not [JOINT=]NUMBER, N.m/A", Excerpt(text));
    constants[joint] = *value;
  }
  return FrictionsOfRobot(arguments.robot, constants, arguments.initial, warnings);
}

/// NAME=VALUE of --armature.
ArmatureForJoints ReadArmature(const std::string& text) {
  const auto [joints, value] = ReadPair(text, "--armature", "NAME=VALUE or PATTERN=VALUE");
  const auto armature = ParseNumber(value);
  if (!armature) {
    Refuse({"--armature"}, "of '{}' is '{}'; it must be a number of 0 or more, kg.m^2 or kg",
           Excerpt(joints), Excerpt(value));
  }
  return {joints, *armature};
}

/// The options with the texts of the command line.
AttachOptions OptionsOf(const AttachArguments& arguments) {
  AttachOptions options = arguments.options;
  for (const std::string& text : arguments.armatures) {
    options.armatures.push_back(ReadArmature(text));
  }
  for (const std::string& text : arguments.packages) {
    options.packages.insert(ReadPair(text, "--package", "NAME=FOLDER"));
  }
  return options;
}

/// What the last line says of a form, and of how it is loaded.
std::string_view HowItActs(FrictionForm form) {
  switch (form) {
    case FrictionForm::native:
      return "as springs with a yield, which need no plugin; a driver sets their yields from the "
             "heat (tools/examples/native_friction.c);";
    case FrictionForm::passive:
      return "without actuators of its own (--as actuator adds them); load it with "
             "libwarmjoint_friction.so";
    case FrictionForm::actuator:
      break;
  }
  return "as actuators (--as passive adds none); load it with libwarmjoint_friction.so";
}

ExitStatus Attach(const AttachArguments& arguments) {
  AttachOptions options = OptionsOf(arguments);
  // each --joint is read at once, and its file is an input that must stay
  std::vector<FrictionForJoint> frictions;
  std::vector<std::string> warnings;
  const std::filesystem::path model = FindRobot(arguments.model, "MODEL");
  std::vector<std::filesystem::path> inputs = FilesOfDescription(model, options.packages);
  if (arguments.joints.empty() && arguments.robot.empty()) {
    Refuse({"attach"}, "needs --joint NAME=FILE, or --friction robot.json for all joints");
  }
  if (!arguments.robot.empty()) {
    frictions = ReadRobot(arguments, warnings);
    inputs.emplace_back(arguments.robot);
  }
  for (const std::string& text : arguments.joints) {
    frictions.push_back(ReadJoint(text, arguments.initial, warnings));
    inputs.emplace_back(text.substr(text.find('=') + 1));
    const auto kind = KindOfFile(inputs.back());
    if (kind) options.kinds.emplace(frictions.back().joint, *kind);
  }

  // nothing is written over, and every doubt of the estimates is told before the model is made
  Outputs outputs({arguments.output}, inputs);
  for (const std::string& warning : warnings) Say(stderr, "warning: {}\n", warning);
  auto [attached, xml] = AttachFrictionAsText(model, frictions, arguments.output, options);
  outputs.Add(arguments.output, std::move(xml));
  outputs.Write();
  for (const std::string& notice : attached.notices) SayNotice("notice: {}\n", notice);
  Say(WordsBeside({arguments.output}), "{}: friction on {} of its joints, {} in MuJoCo {}\n",
      arguments.output, attached.joints.size(), HowItActs(options.form), mj_versionString());
  return ExitStatus::done;
}

void AddModelOptions(CLI::App& parser, AttachArguments& arguments) {
  // what changes of the model besides friction
  AddValue(parser, "--armature", "JOINT=NUMBER", arguments.armatures,
           "NAME=VALUE or PATTERN=VALUE: armature of these joints, kg.m^2 or kg")
      ->take_all();
  std::vector<std::string> names{"auto"};
  for (const auto& [name, unused] : Integrators()) names.push_back(name);
  const auto take = [&arguments](const std::string& choice) {
    if (choice == "auto") {
      arguments.options.integrator_choice = IntegratorChoice::automatic;
    } else {
      arguments.options.integrator = Integrators().at(choice);
    }
  };
  AddChoice(
      parser, "--integrator", take, names,
      "integrator of the result; auto: implicitfast where servos are too stiff for the model's");
  AddValue(parser, "--timestep", "NUMBER", arguments.options.timestep, "step of the result, s");
  AddValue(parser, "--stiffest-drive", "NUMBER", arguments.options.stiffest_drive,
           "h^2 kp + 2 h kv over the joint's inertia of a servo in a program of your own, up to 3");
  AddValue(parser, "--package", "NAME=DIR", arguments.packages,
           "NAME=FOLDER: where package://NAME of a URDF's meshes lies")
      ->take_all();
}

}  // namespace

Command AddAttachCommand(CLI::App& program) {
  // the model, and whose friction goes where
  auto arguments = std::make_shared<AttachArguments>();
  CLI::App* parser = program.add_subcommand("attach", "Friction onto the joints of any robot");
  GiveExample(*parser, "warmjoint attach robot.xml --joint elbow=estimate.json -o warm.xml");
  AddValue(*parser, "-o,--output", "FILE", arguments->output, "the model with friction, MJCF")
      ->required();
  AddValue(*parser, "MODEL", "MODEL", arguments->model,
           "MJCF or URDF file, or one of: warmjoint list robots")
      ->required();
  AddValue(*parser, "--joint", "JOINT=FILE", arguments->joints,
           "NAME=FILE or PATTERN=FILE (a regular expression): estimate.json or another "
           "friction file for these joints")
      ->take_all();
  AddValue(*parser, "--friction", "FILE", arguments->robot,
           "robot.json of identify-robot: friction for all joints that it knows");
  AddValue(*parser, "--torque-constant", "JOINT=NUMBER", arguments->constants,
           "N.m/A at the joint, for frictions of robot.json that are in A: .1 or J4=.1")
      ->take_all();

  // how it acts, and how warm it begins
  AddChoice(*parser, "--as", arguments->options.form, "how friction acts");
  parser->add_flag(
      "--approximate", arguments->options.approximate,
      "--as native: replaces what springs cannot hold, and prints what that is off by");
  AddValue(*parser, "--initial", "TEXT", arguments->initial,
           "heat at the start: cold, end (of the estimate's recording) or settled:SPEED")
      ->capture_default_str();

  // what else the model gets
  parser->add_flag(
      "--sensors", arguments->options.sensors,
      "a sensor JOINT_friction for each joint: force, heat, rise of temperature, loss, held");
  parser->add_flag("--numbers", arguments->options.numbers,
                   "the frictions' numbers as arrays of the model, which may change at run time");

  // the rest of the model
  BeginGroup(*parser, "What else changes in the model");
  AddModelOptions(*parser, *arguments);
  return {parser, [arguments] { return Attach(*arguments); }};
}

}  // namespace warmjoint

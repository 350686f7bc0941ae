// warmjoint export FILE --to FORMAT: friction as the numbers that other engines take, as code or parameters of a controller, or as
// an FMU.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "models/foundation/bad_input.h"
#include "models/foundation/node.h"
#include "models/robots/robot_folder.h"
#include "tools/actions/outputs.h"
#include "tools/cli/command.h"
#include "tools/cli/python_child.h"
#include "tools/cli/typed_options.h"
#include "tools/export/engine_text.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

struct ExportArguments {
  std::string file;
  ExportRequest request;
  double speed = std::numeric_limits<double>::quiet_NaN();  // none given
  std::string output;
  std::string format = "text";
};

/// The archive of an FMU, with the library that a C compiler makes of its sources. Throws BadInput where there is no Python.
std::string FmuArchive(const Exported& exported, const std::string& file) {
  const std::string script = DataFolder() / "tools/python/warmjoint/fmu.py";
  Ended ended;
  for (const std::string& python : Pythons()) {
    ended = CallPython({python, "-B", script}, EngineJson(exported).dump());
    if (ended.ran) break;
  }
  if (!ended.ran) {
    Refuse({file}, "is packed by Python 3, which is not there: sudo apt install python3");
  }
  const std::size_t end = ended.out.find('\n');
  const nlohmann::json head = nlohmann::json::parse(ended.out.substr(0, end), nullptr, false);
  if (!ended.well || end == std::string::npos || !head.is_object()) {
    Refuse({file}, "cannot be packed: Python {}", ReasonOf(ended));
  }
  for (const nlohmann::json& one : head.at("notices")) {
    SayNotice("notice: {}\n", one.get<std::string>());
  }
  return ended.out.substr(end + 1);
}

/// What is written. Throws BadInput.
std::string Content(const ExportArguments& arguments, const Exported& exported) {
  if (arguments.format == "json") return EngineJson(exported).dump(2) + "\n";
  if (exported.request.to != EngineFormat::fmu) return ExportText(exported);
  if (arguments.output.empty()) {
    Refuse({"--output"}, "is missing: an FMU is an archive; give -o FILE.fmu");
  }
  return FmuArchive(exported, arguments.output);
}

ExitStatus Export(const ExportArguments& arguments) {
  // what is read stays, and all that can be refused is first
  Outputs outputs({arguments.output}, {arguments.file});
  ExportRequest request = arguments.request;
  if (!std::isnan(arguments.speed)) request.warmth.speed = arguments.speed;
  const Exported exported = ExportFrictions(ReadJsonNode(arguments.file), request);
  for (const std::string& notice : exported.notices) SayNotice("notice: {}\n", notice);

  const std::string text = Content(arguments, exported);
  if (arguments.output.empty()) {
    fmt::print("{}", text);
  } else {
    outputs.Add(arguments.output, text);
    outputs.Write();
  }
  return ExitStatus::done;
}

}  // namespace

Command AddExportCommand(CLI::App& program) {
  auto arguments = std::make_shared<ExportArguments>();
  CLI::App* parser = program.add_subcommand(
      "export",
      "Friction as numbers of other engines, code or parameters of a controller, or an FMU");
  AddValue(*parser, "FILE", "FILE", arguments->file,
           "estimate.json of identify, robot.json of identify-robot, or a friction file")
      ->required();
  GiveExample(*parser, "warmjoint export estimate.json --to isaaclab --joint elbow -o elbow.py");
  AddChoice(
      *parser, "--to", arguments->request.to,
      "whose numbers; c, cpp, python: code of a controller, with heat and maps; ros2, ur: its "
      "parameters; fmu: FMI 3.0 for co-simulation")
      ->required();

  // how warm the joint is, and what it is called
  constexpr double most = std::numeric_limits<double>::infinity();
  AddNumber(*parser, "--warm", arguments->request.warmth.share, {0, most, "of 0 or more"},
            "0 cold, 1 as warm as sliding at --speed makes it");
  AddNumber(*parser, "--speed", arguments->speed, {1e-9, most, "above 0, rad/s or m/s"},
            "rad/s or m/s; where not given the median of the log, else 1 rad/s or 0.1 m/s");
  AddValue(*parser, "--joint", "NAME", arguments->request.joint,
           "the joint's name, which physx, isaaclab, mjlab and ros2 need; robot.json has its own");
  parser->add_flag("--native", arguments->request.native,
                   "mjcf: MuJoCo 4.0's joint springs with a yield in place of frictionloss");
  AddNumber(*parser, "--timestep", arguments->request.timestep, {1e-9, most, "above 0, s"},
            "--native: step of the model that the springs are for, s");
  AddValue(*parser, "-o,--output", "FILE", arguments->output, "instead of standard output");
  AddChoice(*parser, "--format", arguments->format, {"text", "json"}, "of what is written");
  return {parser, [arguments] { return Export(*arguments); }};
}

}  // namespace warmjoint

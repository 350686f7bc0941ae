// warmjoint export FILE --to ENGINE: friction as the numbers that other engines take, or as code of a controller.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "models/foundation/node.h"
#include "tools/actions/outputs.h"
#include "tools/cli/command.h"
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

ExitStatus Export(const ExportArguments& arguments) {
  // what is read stays, and all that can be refused is first
  Outputs outputs({arguments.output}, {arguments.file});
  ExportRequest request = arguments.request;
  if (!std::isnan(arguments.speed)) request.warmth.speed = arguments.speed;
  const Exported exported = ExportFrictions(ReadJsonNode(arguments.file), request);
  for (const std::string& notice : exported.notices) SayNotice("notice: {}\n", notice);

  const std::string text =
      arguments.format == "json" ? EngineJson(exported).dump(2) + "\n" : ExportText(exported);
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
      "export", "Friction as the numbers of other engines, or as code of a controller");
  AddValue(*parser, "FILE", "FILE", arguments->file,
           "estimate.json of identify, robot.json of identify-robot, or a friction file")
      ->required();
  GiveExample(*parser, "warmjoint export estimate.json --to isaaclab --joint elbow -o elbow.py");
  AddChoice(*parser, "--to", arguments->request.to,
            "whose numbers; c, cpp, python: code of a controller, with heat and maps")
      ->required();

  // how warm the joint is, and what it is called
  constexpr double most = std::numeric_limits<double>::infinity();
  AddNumber(*parser, "--warm", arguments->request.warmth.share, {0, most, "of 0 or more"},
            "0 cold, 1 as warm as sliding at --speed makes it");
  AddNumber(*parser, "--speed", arguments->speed, {1e-9, most, "above 0, rad/s or m/s"},
            "rad/s or m/s; where not given the median of the log, else 1 rad/s or 0.1 m/s");
  AddValue(*parser, "--joint", "NAME", arguments->request.joint,
           "the joint's name, which physx, isaaclab and mjlab need; robot.json has its own");
  parser->add_flag("--native", arguments->request.native,
                   "mjcf: MuJoCo 4.0's joint springs with a yield in place of frictionloss");
  AddNumber(*parser, "--timestep", arguments->request.timestep, {1e-9, most, "above 0, s"},
            "--native: step of the model that the springs are for, s");
  AddValue(*parser, "-o,--output", "FILE", arguments->output, "instead of standard output");
  AddChoice(*parser, "--format", arguments->format, {"text", "json"}, "of what is written");
  return {parser, [arguments] { return Export(*arguments); }};
}

}  // namespace warmjoint

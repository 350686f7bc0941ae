// warmjoint plot RUN -o DIR: the pictures of a run.
#include <fmt/core.h>

#include <memory>

#include "models/foundation/bad_input.h"
#include "tools/command.h"
#include "tools/report/draw/draw_figure.h"
#include "tools/report/run/run_figures.h"

namespace warmjoint {
namespace {

struct PlotArguments {
  std::string source;
  std::string output;
};

ExitStatus PlotRun(const PlotArguments& arguments) {
  const report::RunView view = report::ReadRunView(arguments.source);
  report::Canvas canvas;
  std::filesystem::create_directories(arguments.output);
  for (const report::RunFigure& one : report::RunFigures()) {
    const std::optional<report::Figure> figure = one.make(view);
    if (!figure) continue;
    const auto path = std::filesystem::path(arguments.output) / (one.name + ".png");
    report::WritePng(report::DrawFigure(canvas, *figure).image, figure->finding, path);
    fmt::print("{}: {}\n", path.string(), figure->finding);
  }
  return ExitStatus::done;
}

}  // namespace

Command AddPlotCommand(CLI::App& program) {
  auto arguments = std::make_shared<PlotArguments>();
  CLI::App* parser = program.add_subcommand("plot", "Pictures of a run, as PNG files");
  parser->add_option("RUN", arguments->source, "directory that `run` made")->required();
  parser->add_option("-o,--output", arguments->output, "directory for the pictures; made if absent")
      ->required();
  return {parser, [arguments] { return PlotRun(*arguments); }};
}

}  // namespace warmjoint

// warmjoint report RUN: a run on one web page.
#include <fmt/core.h>

#include <memory>

#include "models/foundation/atomic_file.h"
#include "tools/cli/command.h"
#include "tools/report/page/run_page.h"
#include "tools/report/run/run_figures.h"
#include "tools/store/stored_suite.h"
#include "tools/terminal/activity.h"

namespace warmjoint::inline tools {
namespace {

ExitStatus Report(const std::filesystem::path& directory) {
  Activity activity("reading " + directory.string());
  const RunStore store = RunStore::OpenToRead(directory);
  TellOfEditedSuite(store);
  const report::RunView view = report::ReadRunView(store);
  report::RunPage page{view.board, store.ReadDescription(), {}};
  for (const report::RunFigure& figure : report::RunFigures()) {
    if (auto made = figure.make(view)) page.figures.push_back(*std::move(made));
  }

  activity.Is(fmt::format("drawing {} pictures", page.figures.size()));
  report::Canvas canvas;
  const std::filesystem::path target = directory / "report.html";
  WriteWholeFile(target, report::MakeRunPage(page, canvas));
  activity.Aside([&] { fmt::print("{}\n", target.string()); });
  return ExitStatus::done;
}

}  // namespace

Command AddReportCommand(CLI::App& program) {
  auto directory = std::make_shared<std::string>();
  CLI::App* parser =
      program.add_subcommand("report", "RUN/report.html: a run explained on one page");
  parser->add_option("RUN", *directory, "directory that `run` made")->type_name("RUN")->required();
  return {parser, [directory] { return Report(*directory); }};
}

}  // namespace warmjoint::inline tools

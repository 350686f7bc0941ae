// warmjoint cancel RUN: takes a run's jobs from the cluster.
#include <fmt/format.h>

#include <memory>

#include "tools/cli/command.h"
#include "tools/cluster/slurm.h"
#include "tools/cluster/submissions.h"
#include "tools/terminal/say.h"

namespace warmjoint::inline tools {
namespace {

ExitStatus Cancel(const std::filesystem::path& given) {
  // the plan is read for its refusal alone: it tells a run from any other directory
  const std::filesystem::path run = std::filesystem::absolute(given).lexically_normal();
  ReadPlan(run);
  const std::vector<std::string> jobs = ReadSubmissions(run).Jobs();
  if (jobs.empty()) {
    Say(stdout, "{}: nothing was submitted\n", run.string());
    return ExitStatus::done;
  }

  // jobs that are over already are no failure
  Scancel(jobs);
  Say(stdout,
      "{}: jobs {} are cancelled; what is finished is kept, `warmjoint status {} --resubmit` goes "
      "on\n",
      run.string(), fmt::join(jobs, ", "), run.string());
  return ExitStatus::done;
}

}  // namespace

Command AddCancelCommand(CLI::App& program) {
  auto run = std::make_shared<std::string>();
  CLI::App* parser = program.add_subcommand("cancel", "Cancel the jobs of a run");
  parser->add_option("RUN", *run, "directory of `run --slurm`")->type_name("RUN")->required();
  return {parser, [run] { return Cancel(*run); }};
}

}  // namespace warmjoint::inline tools

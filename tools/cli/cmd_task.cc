// warmjoint task RUN NUMBER: one shard of a planned run.
#include <fmt/format.h>

#include <memory>

#include "tools/cli/command.h"
#include "tools/cli/typed_options.h"
#include "tools/cluster/task.h"
#include "tools/suite/arithmetic.h"
#include "tools/suite/interrupt.h"

namespace warmjoint::inline tools {
namespace {

struct TaskArguments {
  std::string run;
  int shard = 0;
};

ExitStatus RunOneTask(const TaskArguments& arguments) {
  // the same bits on every machine, and an end after the realizations in hand
  SettleArithmetic();
  CatchInterrupts();
  const auto say = [&](const char* words) {
    fmt::print("shard {} of {}: {}\n", arguments.shard, arguments.run, words);
  };

  // another task at work is as good as done; a given-up shard needs a person
  switch (RunTask(std::filesystem::absolute(arguments.run).lexically_normal(), arguments.shard)) {
    case TaskEnd::done:
      say("done");
      return ExitStatus::done;
    case TaskEnd::elsewhere:
      say("another task is at work on it");
      return ExitStatus::done;
    case TaskEnd::interrupted:
      say("interrupted; what is finished is kept, the same command goes on");
      return ExitStatus::interrupted;
    case TaskEnd::failed:
      break;
  }
  say("failed; see `warmjoint status`, which starts it again with --resubmit");
  return ExitStatus::internal_error;
}

}  // namespace

Command AddTaskCommand(CLI::App& program) {
  auto arguments = std::make_shared<TaskArguments>();
  CLI::App* parser = program.add_subcommand(
      "task", "Run one shard of a planned run, as the tasks of `run --slurm` do");
  parser->add_option("RUN", arguments->run, "run directory with a plan")
      ->type_name("RUN")
      ->required();
  parser->add_option("SHARD", arguments->shard, "number of the shard, from 1")
      ->type_name("INTEGER")
      ->required();
  return {parser, [arguments] { return RunOneTask(*arguments); }};
}

}  // namespace warmjoint::inline tools

// The command line as a whole and its subcommands; their one list is in program.cc.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace warmjoint {

/// Exit status of the program, as the contract has it.
enum class ExitStatus {
  done = 0,
  internal_error = 1,
  bad_input = 2,
  nothing_trustworthy = 3,
  output_failed = 4,
  no_answer = 5,
  interrupted = 130,
};

/// One subcommand: its part of the command line, and what it does once that is read.
struct Command {
  CLI::App* parser;
  std::function<ExitStatus()> run;
};

/// Reads the command line and runs its subcommand. Throws BadInput for arguments that cannot be
/// used, with the nearest known option or subcommand.
ExitStatus RunProgram(int argc, const char* const* argv);

Command AddListCommand(CLI::App& program);
Command AddNewCommand(CLI::App& program);
Command AddSimulateCommand(CLI::App& program);
Command AddConvertCommand(CLI::App& program);
Command AddDesignCommand(CLI::App& program);
Command AddCheckCommand(CLI::App& program);
Command AddIdentifyCommand(CLI::App& program);
Command AddIdentifyRobotCommand(CLI::App& program);
Command AddPredictCommand(CLI::App& program);
Command AddCompensateCommand(CLI::App& program);
Command AddPlotCommand(CLI::App& program);
Command AddReportCommand(CLI::App& program);
Command AddAttachCommand(CLI::App& program);
Command AddExportCommand(CLI::App& program);
Command AddRunCommand(CLI::App& program);
Command AddStatusCommand(CLI::App& program);
Command AddMergeCommand(CLI::App& program);
Command AddCompareCommand(CLI::App& program);
Command AddValidateCommand(CLI::App& program);

}  // namespace warmjoint

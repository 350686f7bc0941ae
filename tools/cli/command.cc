#include "tools/cli/command.h"

namespace warmjoint {

std::vector<Command> AddCommands(CLI::App& program) {
  return {
      AddListCommand(program),   AddNewCommand(program),      AddSimulateCommand(program),
      AddCheckCommand(program),  AddIdentifyCommand(program), AddPredictCommand(program),
      AddAttachCommand(program), AddRunCommand(program),      AddStatusCommand(program),
      AddMergeCommand(program),  AddCompareCommand(program),  AddPlotCommand(program),
      AddReportCommand(program),
  };
}

}  // namespace warmjoint

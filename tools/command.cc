#include "tools/command.h"

namespace warmjoint {

std::vector<Command> AddCommands(CLI::App& program) {
  return {
      AddListCommand(program),     AddSimulateCommand(program), AddCheckCommand(program),
      AddIdentifyCommand(program), AddAttachCommand(program),   AddRunCommand(program),
      AddMergeCommand(program),    AddCompareCommand(program),  AddPlotCommand(program),
      AddReportCommand(program),
  };
}

}  // namespace warmjoint

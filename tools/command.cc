#include "tools/command.h"

namespace warmjoint {

std::vector<Command> AddCommands(CLI::App& program) {
  return {
      AddListCommand(program),
      AddCheckCommand(program),
      AddIdentifyCommand(program),
      AddAttachCommand(program),
  };
}

}  // namespace warmjoint

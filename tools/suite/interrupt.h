// Ctrl-C as a wish: loops look at it and stop where nothing is lost.
#pragma once

namespace warmjoint::inline tools {

/// From here on the first SIGINT only sets the wish; a second one ends the process at once.
void CatchInterrupts();

/// Whether Ctrl-C was pressed since CatchInterrupts.
bool Interrupted();

}  // namespace warmjoint::inline tools

// Ctrl-C and kill as a wish: loops look at it and stop where nothing is lost.
#pragma once

namespace warmjoint {

/// From here on the first SIGINT, SIGTERM or SIGHUP only sets the wish; a second of the same kind ends
/// the process at once.
void CatchInterrupts();

/// Whether one came since CatchInterrupts.
bool Interrupted();

}  // namespace warmjoint

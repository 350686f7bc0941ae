// Whether the program keeps to itself what only helps to wait.
#pragma once

namespace warmjoint::inline tools {

/// From here on no progress and no notices (--quiet). Results, warnings and errors are told as ever.
void BeQuiet();

bool IsQuiet();

}  // namespace warmjoint::inline tools

// Output that cannot be written: the third lane of failure beside bad input and mathematics.
#pragma once

#include <warmjoint/errors.h>

#include <string>

namespace warmjoint {

/// Throws OutputFailed: "target: output could not be written: ...". error: an errno.
[[noreturn]] void FailOutput(const std::string& target, int error);

}  // namespace warmjoint

// Output that cannot be written: the third lane of failure beside bad input and mathematics.
#pragma once

#include <stdexcept>
#include <string>

namespace warmjoint::inline models {

/// What was made cannot be kept: a full disk, a closed pipe, a failing device. The message holds
/// place, reason and remedy. Caught once, in main, which prints it and exits 4.
class OutputFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws OutputFailed: "target: output could not be written: ...". error: an errno.
[[noreturn]] void FailOutput(const std::string& target, int error);

}  // namespace warmjoint::inline models

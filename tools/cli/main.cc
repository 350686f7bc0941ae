// The program warmjoint: one subcommand a file, one catch for all of them.
#include <fmt/format.h>

#include "models/foundation/bad_input.h"
#include "models/foundation/keep_memory.h"
#include "tools/cli/program.h"

int main(int argc, char** argv) {
  using warmjoint::ExitStatus;
  warmjoint::KeepFreedMemory();
  ExitStatus status = ExitStatus::internal_error;
  try {
    status = warmjoint::RunProgram(argc, argv);
  } catch (const warmjoint::BadInput& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    status = ExitStatus::bad_input;
  } catch (const std::exception& error) {
    fmt::print(stderr, "internal error: {}\n", error.what());
  }
  return static_cast<int>(status);
}

// The program warmjoint: one subcommand a file, one catch for all of them.
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <new>
#include <system_error>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/keep_memory.h"
#include "tools/cli/command.h"
#include "tools/terminal/say.h"

namespace {

using warmjoint::ExitStatus;

/// Gives standard files that are closed a place of their own, where reading and writing fail: else the
/// next file that is opened would take their number, and words would go into it.
void HoldStandardFiles() {
  for (int file = STDIN_FILENO; file <= STDERR_FILENO; ++file) {
    if (fcntl(file, F_GETFD) >= 0) continue;
    [[maybe_unused]] const int held = open("/dev/null", file == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

/// One paragraph on stderr, whatever the message holds; where that is full too, nothing can be said.
void Complain(const char* kind, const std::string& message) {
  const std::string painted =
      warmjoint::Paint(kind, warmjoint::Colour::red, warmjoint::PageOf(stderr));
  warmjoint::SayText(stderr, fmt::format("{}: {}\n", painted, warmjoint::Printable(message)));
}

ExitStatus Run(int argc, char** argv) {
  try {
    // every failure has its words and its exit status
    return warmjoint::RunProgram(argc, argv);
  } catch (const warmjoint::BadInput& error) {
    Complain("error", error.what());
    return ExitStatus::bad_input;
  } catch (const warmjoint::OutputFailed& error) {
    Complain("error", error.what());
    return ExitStatus::output_failed;
  } catch (const std::filesystem::filesystem_error& error) {
    // a name that the system takes for none, or a folder that cannot be entered
    Complain("error",
             fmt::format("{}: cannot be used: {}", error.path1().string(), error.code().message()));
    const bool full = error.code() == std::errc::no_space_on_device;
    return full ? ExitStatus::output_failed : ExitStatus::bad_input;
  } catch (const std::bad_alloc&) {
    Complain("error", "this takes more memory than there is; give less data or a smaller task");
    return ExitStatus::bad_input;
  } catch (const std::exception& error) {
    // a stream that failed is told of at the end; all else is a mistake of ours
    if (!std::ferror(stdout) && !std::ferror(stderr)) {
      Complain("internal error", error.what());
      return ExitStatus::internal_error;
    }
  }
  return ExitStatus::done;
}

}  // namespace

int main(int argc, char** argv) {
  HoldStandardFiles();
  warmjoint::KeepFreedMemory();
  // a pipe that closes and a limit on files are failures to write as any other
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
  ExitStatus status = Run(argc, argv);

  // what was printed counts once it is out
  const bool lost = std::fflush(stdout) != 0 || std::ferror(stdout) || std::ferror(stderr);
  if (lost && (status == ExitStatus::done || status == ExitStatus::nothing_trustworthy)) {
    Complain("error", fmt::format("standard output: output could not be written: {}",
                                  std::generic_category().message(errno)));
    status = ExitStatus::output_failed;
  }
  return static_cast<int>(status);
}

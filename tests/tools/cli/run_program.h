// The program as its users meet it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace warmjoint {

/// What a run of the program answered.
struct ProgramAnswer {
  int status = 0;   // exit status; 128 + signal for a killed one
  std::string out;  // stdout
  std::string err;  // stderr
};

/// Where the program runs. The variables that tell it how to lay out text (COLUMNS, NO_COLOR) are unset
/// unless they are given here.
struct Surroundings {
  std::filesystem::path folder;                    // empty: that of the test
  std::map<std::string, std::string> environment;  // more variables
};

/// The words of a command, and more behind them.
std::vector<std::string> With(std::vector<std::string> words, const std::vector<std::string>& more);

/// Runs build/warmjoint with the arguments to its end.
ProgramAnswer RunWarmjoint(const std::vector<std::string>& arguments,
                           const Surroundings& where = {});

/// Runs any command, given by its words, the first of which is found in PATH.
ProgramAnswer RunCommandLine(const std::vector<std::string>& words, const Surroundings& where = {});

/// Whether this machine lets a process open a pseudo-terminal: a bare chroot without /dev/pts does not.
bool TerminalsCanBeOpened();

/// Runs build/warmjoint on a terminal of so many columns; `out` holds all that it showed there, stdout and
/// stderr in turn, and `err` nothing. Throws std::system_error where no terminal can be opened.
ProgramAnswer RunOnTerminal(const std::vector<std::string>& arguments, int columns,
                            const Surroundings& where = {});

/// Starts it, sends the signal after `delay` seconds, and returns 128 + signal, or the exit status
/// of a run that was quicker.
int RunAndSignal(const std::vector<std::string>& arguments, int signal, double delay);

}  // namespace warmjoint

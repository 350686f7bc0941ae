// The program as its users meet it.
#pragma once

#include <string>
#include <vector>

namespace warmjoint {

/// What a run of the program answered.
struct Answer {
  int status = 0;   // exit status; 128 + signal for a killed one
  std::string out;  // stdout
  std::string err;  // stderr
};

/// Runs build/warmjoint with the arguments to its end.
Answer RunWarmjoint(const std::vector<std::string>& arguments);

/// Starts it, sends the signal after `delay` seconds, and returns 128 + signal, or the exit status
/// of a run that was quicker.
int RunAndSignal(const std::vector<std::string>& arguments, int signal, double delay);

}  // namespace warmjoint

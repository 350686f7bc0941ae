// A Python that runs a script of this project and ends.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace warmjoint {

/// How a child ended, and what it wrote.
struct Ended {
  bool ran = false;   // there is such a program
  bool well = false;  // and its status was 0
  int signal = 0;     // that ended it; 0: none
  std::string out;
  std::string err;
};

/// The Pythons to try: the environment variable WARMJOINT_PYTHON alone, else python3 in PATH and /usr/bin/python3.
std::vector<std::string> Pythons();

/// Runs a command with `input` on its standard input, and waits for its end.
Ended CallPython(std::vector<std::string> words, std::string_view input);

/// The last line that says something: of a Python that failed, the error itself.
std::string LastLine(std::string text);

}  // namespace warmjoint

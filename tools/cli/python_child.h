// A Python that runs a script of this project and ends: by itself, by a limit, or with this process.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace warmjoint {

/// What a child may use. A script that knows its input sets narrower ones itself.
struct ChildLimits {
  unsigned seconds = 600;                     // of computing, and of wall time
  std::size_t memory = std::size_t{8} << 30;  // bytes of address space
};

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

/// Runs a Python with `input` on its standard input, and waits for its end. It imports nothing from the working folder, neither by
/// itself nor by a relative entry of PYTHONPATH, and is killed when this process ends.
Ended CallPython(std::vector<std::string> words, std::string_view input,
                 const ChildLimits& limits = {});

/// Why a child that did not end well gave no answer, as the end of a sentence that begins with who it is.
std::string ReasonOf(const Ended& ended);

/// The last line that says something: of a Python that failed, the error itself.
std::string LastLine(std::string text);

}  // namespace warmjoint

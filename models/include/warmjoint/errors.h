// Version and errors of the whole library.
#pragma once

#include <stdexcept>
#include <string>

#define WARMJOINT_VERSION_MAJOR 0
#define WARMJOINT_VERSION_MINOR 4
#define WARMJOINT_VERSION_PATCH 0

namespace warmjoint {

/// Version of the library that is linked, "0.4.0"; the macros above are those of the headers.
std::string Version();

/// What was given cannot be used. what() is one sentence with the place (file:line, or the option as the command line calls
/// it), the name, the value, the bound and the remedy. A program exits with 2.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What was made cannot be kept: a full disk, a closed pipe, a failing device. what() says which file, why, and the remedy. A
/// program exits with 4.
class OutputFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace warmjoint

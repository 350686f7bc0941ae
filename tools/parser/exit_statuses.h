// What the program's exit statuses mean, in one list for help and man pages.
#pragma once

#include <vector>

namespace warmjoint::inline tools {

struct ExitMeaning {
  int status;
  const char* meaning;
};

inline const std::vector<ExitMeaning>& ExitMeanings() {
  static const std::vector<ExitMeaning> meanings{
      {0, "done"},
      {1, "internal error"},
      {2, "bad input"},
      {3, "identified nothing trustworthy"},
      {4, "output could not be written"},
      {5, "an identifier answered in no realization of a run"},
      {130, "interrupted"},
  };
  return meanings;
}

}  // namespace warmjoint::inline tools

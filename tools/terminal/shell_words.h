// Commands as lists of words, and as lines of a shell.
#pragma once

#include <string>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint {

/// The words of a command: blanks part them, '...' and "..." hold them together, a backslash takes the
/// next character as it is. Nothing is expanded. Throws BadInput from `place` for a quote without
/// its end.
std::vector<std::string> SplitCommand(const std::string& command, const Place& place);

/// The inverse: a text that SplitCommand, and a shell as well, reads as these words.
std::string JoinCommand(const std::vector<std::string>& words);

/// The text with every `from` replaced.
std::string Replaced(std::string text, const std::string& from, const std::string& to);

/// Pointers to the words, which must outlive them, with a null pointer behind.
inline std::vector<char*> ExecWords(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace warmjoint

// Words as exec of the system takes them.
#pragma once

#include <string>
#include <vector>

namespace warmjoint {

/// Pointers to the words, which must outlive them, with a null pointer behind.
inline std::vector<char*> ExecWords(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace warmjoint

#include "tools/suite/command_line.h"

#include <filesystem>

#include "tools/suite/run_command.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint::inline tools {
namespace {

namespace fs = std::filesystem;

/// Whether a word of a command names a file, seen from `folder`.
bool NamesFile(const std::string& word, bool program, const fs::path& folder) {
  std::error_code ignored;
  if (word.empty() || !fs::is_regular_file(folder / word, ignored)) return false;
  const bool has_folder = word.find('/') != std::string::npos;
  return !program || has_folder || FindProgram(word) == word;
}

std::string Absolute(const std::string& word, const fs::path& folder) {
  return fs::absolute(folder / word);
}

}  // namespace

std::vector<std::string> WithAbsoluteFiles(std::vector<std::string> words, const fs::path& folder) {
  for (size_t i = 0; i < words.size(); ++i) {
    if (NamesFile(words[i], i == 0, folder)) words[i] = Absolute(words[i], folder);
  }
  return words;
}

std::string WithAbsoluteFiles(const std::string& line, const fs::path& folder) {
  std::string result;
  bool first = true;
  // words and the blanks between them in turn
  for (size_t begin = 0; begin < line.size();) {
    const bool blank = IsBlank(line[begin]);
    size_t end = begin;
    while (end < line.size() && IsBlank(line[end]) == blank) ++end;
    const std::string part = line.substr(begin, end - begin);
    // files are meant from the folder of the suite, wherever the command runs
    result += !blank && NamesFile(part, first, folder) ? ShellQuoted(Absolute(part, folder)) : part;
    first = first && blank;
    begin = end;
  }
  return result;
}

}  // namespace warmjoint::inline tools

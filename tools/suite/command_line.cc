#include "tools/suite/command_line.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "models/foundation/excerpt.h"
#include "tools/suite/run_command.h"

namespace warmjoint::inline tools {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBlanks = " \t\r\n";

bool IsBlank(char c) { return kBlanks.find(c) != std::string_view::npos; }

/// Whether the word means itself to a shell.
bool IsPlain(const std::string& word) {
  constexpr std::string_view plain = "_-./:=,+@%{}";
  return !word.empty() && std::all_of(word.begin(), word.end(), [&](char c) {
    const bool letter = ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9');
    return letter || plain.find(c) != std::string_view::npos;
  });
}

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

std::string Quoted(const std::string& word) {
  return IsPlain(word) ? word : "'" + Replaced(word, "'", R"('\'')") + "'";
}

}  // namespace

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

std::vector<std::string> SplitCommand(const std::string& command, const Place& place) {
  std::vector<std::string> words;
  bool within = false;  // a word, which may be empty between quotes
  char quote = 0;
  for (size_t i = 0; i < command.size(); ++i) {
    const char c = command[i];
    if (!quote && IsBlank(c)) {
      within = false;
      continue;
    }
    if (!within) words.emplace_back();
    within = true;
    if (c == quote) {
      quote = 0;
    } else if (!quote && (c == '\'' || c == '"')) {
      quote = c;
    } else if (c == '\\' && quote != '\'' && i + 1 < command.size()) {
      words.back() += command[++i];
    } else {
      words.back() += c;
    }
  }
  if (quote) Refuse(place, "the command '{}' has a {} without its end", Excerpt(command), quote);
  return words;
}

std::string JoinCommand(const std::vector<std::string>& words) {
  std::string command;
  for (const std::string& word : words) command += (command.empty() ? "" : " ") + Quoted(word);
  return command;
}

std::vector<std::string> WithAbsoluteFiles(std::vector<std::string> words, const fs::path& folder) {
  for (size_t i = 0; i < words.size(); ++i) {
    if (NamesFile(words[i], i == 0, folder)) words[i] = Absolute(words[i], folder);
  }
  return words;
}

std::string WithAbsoluteFiles(const std::string& line, const fs::path& folder) {
  std::string result;
  bool first = true;
  for (size_t begin = 0; begin < line.size();) {
    const bool blank = IsBlank(line[begin]);
    size_t end = begin;
    while (end < line.size() && IsBlank(line[end]) == blank) ++end;
    const std::string part = line.substr(begin, end - begin);
    result += !blank && NamesFile(part, first, folder) ? Quoted(Absolute(part, folder)) : part;
    first = first && blank;
    begin = end;
  }
  return result;
}

}  // namespace warmjoint::inline tools

#include "tools/terminal/shell_words.h"

#include <algorithm>
#include <string_view>

#include "models/foundation/excerpt.h"

namespace warmjoint {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

/// Whether the word means itself to a shell.
bool IsPlain(const std::string& word) {
  // without blanks, quotes, wildcards and what else a shell may expand
  constexpr std::string_view plain = "_-./:=,+@%{}";
  const bool is_plain = std::all_of(word.begin(), word.end(), [&](char c) {
    const bool letter = ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9');
    return letter || plain.find(c) != std::string_view::npos;
  });
  // {recording} stays as it is, {a,b} and {1..3} become several words
  const auto has = [&](std::string_view part) { return word.find(part) != std::string::npos; };
  const bool is_several = has("{") && (has(",") || has(".."));
  return !word.empty() && is_plain && !is_several;
}

/// The word as a shell reads it back: in quotes where it needs them.
std::string ShellQuoted(const std::string& word) {
  return IsPlain(word) ? word : "'" + Replaced(word, "'", R"('\'')") + "'";
}

}  // namespace

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  // the search goes on behind what was put in
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
    // a blank outside of quotes ends a word
    if (!quote && kBlanks.find(c) != std::string_view::npos) {
      within = false;
      continue;
    }

    // what else comes belongs to a word
    if (!within) words.emplace_back();
    within = true;

    // quotes are taken off; a backslash keeps the next character as it is
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
  for (const std::string& word : words) command += (command.empty() ? "" : " ") + ShellQuoted(word);
  return command;
}

}  // namespace warmjoint

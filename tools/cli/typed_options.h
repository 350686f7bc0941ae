// Options as help shows them: what is taken as it stands, one of a list, a number within bounds.
#pragma once

#include <warmjoint/field.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace warmjoint {

/// What help shows under "Usage": a command that works as it stands, but for the names of files.
void GiveExample(CLI::App& parser, const std::string& command);

/// Options that are added from here on stand under this heading of the help; without one under "Options", the first.
void BeginGroup(CLI::App& parser, const std::string& heading);

/// Adds an option, or an argument, whose value is taken as it is written. form: what help shows of the value, "FILE".
template <typename T>
CLI::Option* AddValue(CLI::App& parser, const std::string& name, const std::string& form, T& value,
                      const std::string& description) {
  return parser.add_option(name, value, description)->type_name(form);
}

/// Adds an option, or an argument, for one of the choices, which help shows as the form of the value. What is none of
/// them is refused with the nearest. take: gets the choice; synonyms: what other fields call one, {"prismatic", "linear"}.
CLI::Option* AddChoice(CLI::App& parser, const std::string& name,
                       const std::function<void(const std::string& choice)>& take,
                       const std::vector<std::string>& choices, const std::string& description,
                       const std::map<std::string, std::string>& synonyms = {});

/// The same for a text, which holds the default.
CLI::Option* AddChoice(CLI::App& parser, const std::string& name, std::string& value,
                       const std::vector<std::string>& choices, const std::string& description);

/// The same for a choice whose words a file has, too (field.h).
template <typename E>
requires std::is_enum_v<E> CLI::Option* AddChoice(
    CLI::App& parser, const std::string& name, E& value, const std::string& description,
    const std::map<std::string, std::string>& synonyms = {}) {
  std::vector<std::string> words;
  for (const Word<E>& word : WordsOf(value)) words.emplace_back(word.name);
  const auto take = [&value](const std::string& given) {
    for (const Word<E>& word : WordsOf(value)) {
      if (word.name == given) value = word.value;
    }
  };
  return AddChoice(parser, name, take, words, description, synonyms)
      ->default_str(std::string(NameOf(value)));
}

/// What a number of the command line may be.
struct NumberRange {
  double lowest;
  double highest;     // infinity: none
  const char* words;  // "of 0 or more, s"
};

/// Adds an option for a finite number within bounds; other texts are refused with these bounds.
CLI::Option* AddNumber(CLI::App& parser, const std::string& name, double& number,
                       const NumberRange& bounds, const std::string& description);

/// Adds an option for a whole number from `lowest` to `highest`. Other texts are refused with the
/// bounds; a negative number does not wrap round.
CLI::Option* AddWholeNumber(CLI::App& parser, const std::string& name,
                            std::optional<std::uint64_t>& number, std::uint64_t lowest,
                            std::uint64_t highest, const std::string& description);

}  // namespace warmjoint

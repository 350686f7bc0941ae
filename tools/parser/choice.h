// Options whose value is one of a list, or a number within bounds.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

namespace warmjoint::inline tools {

/// What another field calls a choice: {"prismatic", "linear"}.
using Synonyms = std::map<std::string, std::string>;

/// Throws BadInput, with the nearest choice, where `value` is none of them. what: "--joint".
void CheckChoice(const std::string& what, const std::string& value,
                 const std::vector<std::string>& choices, const Synonyms& synonyms = {});

/// Adds an option, or an argument, for one of the choices; `value` holds its default. Help shows the
/// choices as the form of the value.
CLI::Option* AddChoice(CLI::App& parser, const std::string& name, std::string& value,
                       const std::vector<std::string>& choices, const std::string& description,
                       const Synonyms& synonyms = {});

/// What a number of the command line may be.
struct Bounds {
  double lowest;
  double highest;     // infinity: none
  const char* words;  // "above 0, s"
  bool open = false;  // `lowest` itself is too low
};

/// Adds an option for a finite number within bounds; other texts are refused with these bounds.
CLI::Option* AddNumber(CLI::App& parser, const std::string& name, double& number,
                       const Bounds& bounds, const std::string& description);

}  // namespace warmjoint::inline tools

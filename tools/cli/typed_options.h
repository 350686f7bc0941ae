// Options whose value is one of a list, or a number within bounds.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace warmjoint::inline tools {

/// Adds an option, or an argument, for one of the choices, which help shows as the form of the value; `value` holds
/// its default. What is none of them is refused with the nearest. synonyms: what other fields call a choice,
/// {"prismatic", "linear"}.
CLI::Option* AddChoice(CLI::App& parser, const std::string& name, std::string& value,
                       const std::vector<std::string>& choices, const std::string& description,
                       const std::map<std::string, std::string>& synonyms = {});

/// What a number of the command line may be.
struct Bounds {
  double lowest;
  double highest;     // infinity: none
  const char* words;  // "of 0 or more, s"
};

/// Adds an option for a finite number within bounds; other texts are refused with these bounds.
CLI::Option* AddNumber(CLI::App& parser, const std::string& name, double& number,
                       const Bounds& bounds, const std::string& description);

/// Adds an option for a whole number from `lowest` to `highest`. Other texts are refused with the
/// bounds; a negative number does not wrap round.
CLI::Option* AddWholeNumber(CLI::App& parser, const std::string& name,
                            std::optional<std::uint64_t>& number, std::uint64_t lowest,
                            std::uint64_t highest, const std::string& description);

}  // namespace warmjoint::inline tools

// Whole numbers of the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

namespace warmjoint::inline tools {

/// Adds an option for a whole number from `lowest` to `highest`. Other texts are refused with the
/// bounds; a negative number does not wrap round.
CLI::Option* AddWholeNumber(CLI::App& parser, const std::string& name,
                            std::optional<std::uint64_t>& number, std::uint64_t lowest,
                            std::uint64_t highest, const std::string& description);

}  // namespace warmjoint::inline tools

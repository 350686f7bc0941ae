// YAML: documents as trees of values with their lines, and trees as YAML.
#pragma once

#include <string>

#include "models/foundation/node.h"
#include "scenarios/scenario.h"

namespace warmjoint {

/// Bounds of a document: bytes; levels within levels; values, those of aliases counted each time.
inline constexpr std::size_t kLargestDocument = std::size_t{16} << 20;
inline constexpr int kDeepestDocument = 64;
inline constexpr int kMostValues = 1'000'000;

/// Parses text and changes entries of it; refusals of what a setting changed name the setting
/// instead of a line. Scalars are texts. file: for messages. Throws BadInput where text or setting
/// is no YAML (with the line), holds itself by an alias, exceeds the bounds above, has a key twice,
/// and where the key of a setting leads through a value that holds no keys.
Node ParseYaml(const std::string& text, const std::string& file, const Settings& settings = {});

/// A map as YAML, one entry a line behind `indent`; small maps, and lists of numbers, on one line.
std::string ToYaml(const Tree& map, const std::string& indent = "");

/// A value as YAML on one line.
std::string ToFlowYaml(const Tree& value);

}  // namespace warmjoint

// Models that are short to write and long to build.
#pragma once

#include <filesystem>
#include <string>

namespace warmjoint::inline sim {

/// Most copies that the repeating elements of a model may make together. MuJoCo builds 1,000 copies in half a second
/// and takes a time that grows with the square of their number.
inline constexpr double kMostCopies = 10'000;

/// Refuses an MJCF, with those that it includes, whose <replicate>, <composite> and <flexcomp> make more copies than
/// kMostCopies, with file, line and number; one that nests deeper than 500 elements or includes more than 1,000
/// files; and built-in textures beyond a GiB. What else is wrong, MuJoCo refuses. text: of the file at `path`.
void CheckRepeats(const std::string& text, const std::filesystem::path& path);

}  // namespace warmjoint::inline sim

// Descriptions of robots as text, MJCF and URDF: which files they name, and what is refused before a parser sees it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace warmjoint {

/// Folders of ROS packages by their names, as attach takes them.
using DescriptionPackages = std::map<std::string, std::filesystem::path>;

/// A description and all that it includes, as it was read.
struct DescriptionFiles {
  std::string text;                          // of the file itself
  std::vector<std::filesystem::path> texts;  // the file itself first, then what it includes
  std::vector<std::filesystem::path>
      assets;  // meshes, textures and whatever else is there under a name in it
};

/// Reads a description, MJCF or URDF, and what it includes, and looks for the files that it names: beside each text, and in the
/// folders of <compiler>. Throws BadInput with file and line for
/// - what is no regular file, of which a reader might wait for ever, and texts of more than 64 MiB,
/// - elements nested more than 500 levels deep,
/// - numbers that are NaN, or infinite where they are no bound of something, and in a URDF what is no number, by link or joint,
/// - masses and sizes below 0 in a URDF,
/// - counts and sizes that would make more than a million elements, or arrays of more than 2^27 numbers.
DescriptionFiles ReadDescription(const std::filesystem::path& file,
                                 const DescriptionPackages& packages = {});

/// The files of a description that a command reads and must not write over: itself, what it includes, its assets.
std::vector<std::filesystem::path> FilesOfDescription(const std::filesystem::path& file,
                                                      const DescriptionPackages& packages = {});

}  // namespace warmjoint

// Folders that tests need at run time.
#pragma once

#include <filesystem>

namespace warmjoint::test {

/// Root of the project's sources.
std::filesystem::path SourceFolder();

/// Root of the build: the program and the plugin lie here.
std::filesystem::path BuildFolder();

/// Real recordings and robots that are not part of the project: the environment
/// variable WARMJOINT_SHARED, else the folder set at configuration. It may not exist.
std::filesystem::path SharedFolder();

}  // namespace warmjoint::test

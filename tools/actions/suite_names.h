// The project's suites by name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace warmjoint {

/// Names of the project's suites, sorted: each is a file of scenarios/suites.
std::vector<std::string> SuiteNames();

/// The file of one of them.
std::filesystem::path SuiteFile(const std::string& name);

/// The file of a suite: the path itself where there is such a file, else that of the project's suite of
/// this name. Throws BadInput with the nearest name.
std::string FindSuite(const std::string& name_or_path);

}  // namespace warmjoint

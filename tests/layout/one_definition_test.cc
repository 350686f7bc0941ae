// A name of a type stands for one type in each namespace: what the linker sees in tools/odr, seen here by its text.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/folders.h"

namespace {
namespace fs = std::filesystem;
using warmjoint::test::SourceFolder;

/// The types that a file defines outside any function and any other type, each with its namespaces.
/// What stands in a namespace without a name is the file's own and not told.
std::set<std::string> TypesOf(const fs::path& path) {
  static const std::regex opens(R"(^(?:inline )?namespace ([\w:]*(?:::inline )?[\w:]*) ?\{)");
  static const std::regex closes(R"(^\}  // namespace)");
  static const std::regex defines(
      R"(^(?:template <.*> ?)?(?:struct|class|enum class|enum) ([\w:]+)[^;]*\{)");

  std::set<std::string> types;
  std::vector<std::string> open;
  std::ifstream stream(path);
  for (std::string line; std::getline(stream, line);) {
    std::smatch match;
    if (std::regex_search(line, match, opens)) {
      open.push_back(match[1]);
    } else if (std::regex_search(line, closes) && !open.empty()) {
      open.pop_back();
    } else if (std::regex_search(line, match, defines)) {
      // a namespace without a name makes the type the file's own
      std::string name;
      bool own = false;
      for (const std::string& space : open) {
        own = own || space.empty();
        name += space + "::";
      }
      if (!own) types.insert(name + match[1].str());
    }
  }
  return types;
}

TEST(OneDefinition, EachTypeOfTheProductHasItsOwnName) {
  std::map<std::string, std::vector<std::string>> files;
  for (const char* room : {"models", "scenarios", "sim", "identification", "tools"}) {
    for (const auto& entry : fs::recursive_directory_iterator(SourceFolder() / room)) {
      const fs::path& path = entry.path();
      if (path.extension() != ".h" && path.extension() != ".cc") continue;
      for (const std::string& type : TypesOf(path)) {
        files[type].push_back(fs::relative(path, SourceFolder()).string());
      }
    }
  }

  // so few would mean that the text is no longer read as it is written
  EXPECT_GT(files.size(), 300u);
  for (const auto& [type, places] : files) {
    std::string list;
    for (const std::string& place : places) list += "\n  " + place;
    EXPECT_EQ(places.size(), 1u) << type << " is defined in" << list;
  }
}

TEST(OneDefinition, ATypeDefinedTwiceIsFound) {
  const fs::path folder = fs::path(testing::TempDir()) / "one_definition";
  fs::create_directories(folder);
  std::ofstream(folder / "a.h")
      << "namespace warmjoint::inline tools {\nstruct One {\n};\n}  // namespace warmjoint\n";
  std::ofstream(folder / "b.cc")
      << "namespace warmjoint::inline tools {\nnamespace {\nstruct Own {\n};\n}  // namespace\n"
         "class One final : Base {\n};\nstruct Later;\n}  // namespace warmjoint\n";

  EXPECT_EQ(TypesOf(folder / "a.h"), std::set<std::string>{"warmjoint::inline tools::One"});
  EXPECT_EQ(TypesOf(folder / "b.cc"), std::set<std::string>{"warmjoint::inline tools::One"});
  fs::remove_all(folder);
}
}  // namespace

#include "tools/report/draw/theme.h"

#include <gtest/gtest.h>

#include <map>

#include "identification/identifiers/identifier_list.h"

namespace warmjoint::report {
namespace {

TEST(IdentifierHue, TellsTheMethodsOfThePaperAndTheirRivalsApart) {
  std::map<Hue, std::string> taken;
  for (const char* name : {"nominal-ls", "energy-als", "energy-ml", "rls", "kalman", "motor-ridge",
                           "position-ridge"}) {
    const auto [entry, is_new] = taken.emplace(IdentifierHue(name), name);
    EXPECT_TRUE(is_new) << name << " looks like " << entry->second;
  }
}

TEST(IdentifierHue, StaysWhereAnIdentifierGotAnotherName) {
  for (const Identifier& identifier : Identifiers()) {
    if (identifier.earlier_name.empty()) continue;
    EXPECT_EQ(IdentifierHue(identifier.earlier_name), IdentifierHue(identifier.name));
  }
}

TEST(IdentifierHue, IsNeverThatOfTextOrOfTheGroundLine) {
  for (const Identifier& identifier : Identifiers()) {
    EXPECT_NE(IdentifierHue(identifier.name), Hue::text) << identifier.name;
    if (identifier.name != "nominal-ls") {
      EXPECT_NE(IdentifierHue(identifier.name), Hue::grey) << identifier.name;
    }
  }
}

}  // namespace
}  // namespace warmjoint::report

// Prints the attributes of the plugin as a table for its README: tools/docs/tables writes it there.
#include <fmt/core.h>

#include "sim/plugin/attributes.h"

int main() {
  fmt::print("| attribute | unit | allowed | meaning |\n|---|---|---|---|\n");
  for (const warmjoint::PluginAttribute& a : warmjoint::PluginAttributes()) {
    fmt::print("| {} | {} | {} | {} |\n", a.name, a.unit, a.bound, a.meaning);
  }
}

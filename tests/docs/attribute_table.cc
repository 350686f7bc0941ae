// Prints the attributes of the plugin as a table for its README: tools/docs/tables writes it there.
#include <fmt/core.h>

#include "sim/plugin/attributes.h"

namespace warmjoint {
namespace {

std::string Allowed(const std::optional<double>&, const Bounds& bounds) { return bounds.Words(); }
std::string Allowed(const std::string&, const Bounds&) { return "text"; }
std::string Allowed(bool, const Bounds&) { return "true or false"; }
std::string Allowed(const std::filesystem::path&, const Bounds&) { return "path"; }
std::string Allowed(const Tree&, const Bounds&) { return "JSON"; }

struct Rows {
  template <class T>
  void Field(std::string_view name, T* value, const FieldInfo& info) {
    fmt::print("| {} | {} | {} | {} |\n", name, info.unit, Allowed(*value, info.bounds),
               info.meaning);
  }
};

}  // namespace
}  // namespace warmjoint

int main() {
  fmt::print("| attribute | unit | allowed | meaning |\n|---|---|---|---|\n");
  warmjoint::Rows rows;
  warmjoint::PluginAttributes().Serialize(&rows);
}

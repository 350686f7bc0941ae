#include "tools/cli/foretold_table.h"

#include <fmt/format.h>

#include "models/foundation/node.h"
#include "models/foundation/serialize.h"
#include "tools/design/aim.h"

namespace warmjoint {

ForetoldAnswer ReadForetold(const std::string& file) {
  const Node node = ReadJsonNode(file).With(UnknownKeys::ignored);
  std::vector<ForetoldAnswer> answers;
  ReadValue(node.Require("foretold", "is it design.json of `warmjoint design`?"), &answers, {});
  if (answers.empty()) node.Require("foretold", "").RefuseValue("a list of answers");
  return answers.back();
}

std::string ForetoldToText(const ForetoldAnswer& foretold, const Estimate& estimate,
                           const Page& page) {
  Table table{{"parameter", "unit", "foretold", "std", "reached", "std"}, {}};
  const auto number = [](std::optional<double> value) {
    return value ? fmt::format("{:.4g}", *value) : std::string("-");
  };
  for (const EstimatedParameter& one : foretold.parameters) {
    const EstimatedParameter* const reached = estimate.Find(one.name);
    if (!reached) continue;
    table.rows.push_back({one.name, one.unit, number(one.value), number(one.std),
                          number(reached->value), number(reached->std)});
  }
  return fmt::format("\nforetold of {:.3g} min, had the friction been the middle of the prior\n",
                     foretold.minutes) +
         TableToText(table, 2, page);
}

}  // namespace warmjoint

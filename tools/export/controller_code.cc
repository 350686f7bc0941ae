#include "tools/export/controller_code.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/friction/compensator.h"
#include "models/friction/friction_json.h"
#include "tools/export/code_lines.h"

namespace warmjoint {
namespace {

/// "4, 5.5" of numbers.
std::string Numbers(std::span<const double> values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(Literal(value));
  return fmt::format("{}", fmt::join(texts, ", "));
}

const char* QuantityName(wj_quantity quantity) {
  constexpr const char* names[] = {"WJ_POSITION", "WJ_MOTOR_POSITION", "WJ_VELOCITY", "WJ_ENERGY",
                                   "WJ_LOAD"};
  return names[quantity];
}

/// Arrays of the centres and weights of all maps, and the array of the maps.
std::string MapsText(const std::string& name, const wj_friction& numbers) {
  std::string arrays, rows;
  for (int m = 0; m < numbers.map_count; ++m) {
    const wj_map& map = numbers.maps[m];
    std::string axes;
    size_t size = 1;
    for (int a = 0; a < map.axis_count; ++a) {
      const wj_axis& axis = map.axes[a];
      const auto count = static_cast<size_t>(axis.count);
      size *= count;
      const std::string centres = fmt::format("{}_centres_{}_{}", name, m, a);
      arrays += fmt::format("static const wj_real {}[] = {{{}}};\n", centres,
                            Numbers(std::span(axis.centres, count)));
      axes += fmt::format("{}{{{}, {}, {}, {}, {}, {}}}", a > 0 ? ", " : "",
                          QuantityName(axis.quantity),
                          axis.sides == WJ_APART ? "WJ_APART" : "WJ_TOGETHER", axis.count, centres,
                          Literal(axis.width), Literal(axis.period));
    }
    arrays += fmt::format("static const wj_real {}_weights_{}[] = {{{}}};\n", name, m,
                          Numbers(std::span(map.weights, size)));
    constexpr const char* factors[] = {"WJ_BY_ONE", "WJ_BY_DIRECTION", "WJ_BY_VELOCITY"};
    rows += fmt::format("    {{{}, {{{}}}, {}, {}, {}_weights_{}}},\n", map.axis_count, axes,
                        map.kernels == WJ_PLAIN ? "WJ_PLAIN" : "WJ_NORMALISED", factors[map.factor],
                        name, m);
  }
  if (rows.empty()) return "";
  return arrays + fmt::format("static const wj_map {}_maps[] = {{\n{}}};\n", name, rows);
}

}  // namespace

std::string CFriction(const SeenFriction& seen, const std::string& name) {
  const CompensatorNumbers held(seen.friction, seen.doubt);
  const wj_friction& numbers = held.numbers();
  std::string text =
      MapsText(name, numbers) + fmt::format("static const wj_friction {} = {{\n", name);
  for (const CodeLine& line : CodeLinesOf(seen, numbers)) {
    text += fmt::format("    .{} = {},{}\n", line.member, Literal(line.value),
                        CommentOf(line, seen, "//"));
  }
  if (numbers.map_count > 0) {
    text += fmt::format("    .map_count = {},\n    .maps = {}_maps,\n", numbers.map_count, name);
  }
  return text + "};\n";
}

namespace {

std::string CppText(const SeenFriction& seen, const std::string& name) {
  const CompensatorNumbers held(seen.friction, seen.doubt);
  const wj_friction& numbers = held.numbers();
  std::string text =
      MapsText(name, numbers) +
      fmt::format("static inline wj_friction {}() {{\n  wj_friction friction{{}};\n", name);
  for (const CodeLine& line : CodeLinesOf(seen, numbers)) {
    text += fmt::format("  friction.{} = {};{}\n", line.member, Literal(line.value),
                        CommentOf(line, seen, "//"));
  }
  if (numbers.map_count > 0) {
    text += fmt::format("  friction.map_count = {};\n  friction.maps = {}_maps;\n",
                        numbers.map_count, name);
  }
  return text + "  return friction;\n}\n";
}

/// What JSON calls null is left out, since Python does not know it.
Tree WithoutNull(const Tree& tree) {
  if (!tree.is_structured()) return tree;
  Tree kept = tree.is_object() ? Tree::object() : Tree::array();
  for (const auto& [key, value] : tree.items()) {
    if (value.is_null()) continue;
    if (tree.is_object()) {
      kept[key] = WithoutNull(value);
    } else {
      kept.push_back(WithoutNull(value));
    }
  }
  return kept;
}

std::string PythonText(const SeenFriction& seen, const std::string& name) {
  const CompensatorNumbers held(seen.friction, seen.doubt);
  std::string text;
  for (const CodeLine& line : CodeLinesOf(seen, held.numbers())) {
    text += fmt::format("# {} = {:.6g}, {}\n", line.member, line.value, SaidOf(line, seen));
  }
  text += fmt::format("{} = Compensator(\n    {}", name,
                      WithoutNull(FrictionToTree(seen.friction)).dump());
  const FrictionDoubt& doubt = seen.doubt;
  const std::pair<const char*, double> known[] = {{"level_std", doubt.level_std},
                                                  {"heat_std", doubt.heat_std},
                                                  {"noise", doubt.noise},
                                                  {"noise_time", doubt.noise_time}};
  for (const auto& [key, value] : known) {
    if (value != 0) text += fmt::format(",\n    {}={}", key, Literal(value));
  }
  return text + ")\n";
}

}  // namespace

std::string CodeText(const std::vector<SeenFriction>& frictions, EngineFormat format) {
  const bool is_python = format == EngineFormat::python;
  std::string text =
      is_python ? "from warmjoint import Compensator\n" : "#include <warmjoint/compensate.h>\n";
  std::set<std::string> names;
  for (const SeenFriction& seen : frictions) {
    const std::string name = CodeName(seen.joint);
    if (!names.insert(name).second) {
      Refuse({"joint " + Excerpt(seen.joint)},
             "is {} in {}, as another joint is; rename one of them in the file", name,
             NameOf(format));
    }
    text +=
        fmt::format("\n{} {}: friction with its 95 % intervals, law {}{}\n", is_python ? "#" : "//",
                    Printable(seen.joint.empty() ? "joint" : seen.joint), seen.friction.law,
                    LeftOutOf(seen.friction));
    text += format == EngineFormat::c     ? CFriction(seen, name)
            : format == EngineFormat::cpp ? CppText(seen, name)
                                          : PythonText(seen, name);
  }
  return text;
}

}  // namespace warmjoint

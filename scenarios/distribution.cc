#include "scenarios/distribution.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace warmjoint {

double Distribution::Draw(RandomStream& random) const {
  switch (kind) {
    case Kind::fixed:
      return a;
    case Kind::uniform:
      return random.Uniform(a, b);
    case Kind::normal:
      return a + b * random.Normal();
    case Kind::log_uniform:
      return a * std::pow(b / a, random.Uniform());
  }
  return a;
}

bool IsDistribution(const Node& node) {
  if (!node.IsMap() || node.tree().size() != 1) return false;
  const std::string key = node.Keys().front();
  return std::ranges::any_of(WordsOf(Distribution::Kind()),
                             [&](const auto& word) { return word.name == key; });
}

void ReadValue(const Node& node, Distribution* value, const FieldInfo& info) {
  using Kind = Distribution::Kind;
  if (node.IsScalar()) {
    *value = {Kind::fixed, node.Number(info.bounds), 0};
    return;
  }
  node.RequireKeys({"uniform", "log_uniform", "normal"});
  if (!IsDistribution(node)) node.RefuseValue("a number or one of uniform, log_uniform, normal");

  // two numbers, by what they mean
  if (const auto normal = node.Find("normal")) {
    const char* must_be = "[mean, standard deviation]";
    const auto numbers = normal->List(must_be);
    if (numbers.size() != 2) normal->RefuseValue(must_be);
    *value = {Kind::normal, numbers[0].Number(info.bounds), numbers[1].Number({.above = 0})};
    return;
  }
  const auto logarithmic = node.Find("log_uniform");
  const auto [a, b] = logarithmic
                          ? logarithmic->Interval({.above = 0})
                          : node.Require("uniform", "give [lower, upper]").Interval(info.bounds);
  *value = {logarithmic ? Kind::log_uniform : Kind::uniform, a, b};
}

Tree WriteValue(const Distribution& value) {
  if (value.kind == Distribution::Kind::fixed) return value.a;
  return {{NameOf(value.kind), {value.a, value.b}}};
}

}  // namespace warmjoint

#include "scenarios/yaml_distribution.h"

#include <algorithm>

namespace warmjoint::inline scenarios {
namespace {

const std::vector<std::string>& Kinds() {
  static const std::vector<std::string> kinds{"uniform", "log_uniform", "normal"};
  return kinds;
}

Distribution ReadNormal(const YamlValue& value, Bound bound) {
  const char* must_be = "[mean, standard deviation]";
  const auto numbers = value.List(must_be);
  if (numbers.size() != 2) value.RefuseValue(must_be);
  return {Distribution::Kind::normal, numbers[0].Number(bound), numbers[1].Number(Bound::positive)};
}

}  // namespace

bool IsDistribution(const YamlValue& value) {
  if (!value.IsMap()) return false;
  const auto keys = value.Keys();
  return keys.size() == 1 && std::find(Kinds().begin(), Kinds().end(), keys[0]) != Kinds().end();
}

Distribution ReadDistribution(const YamlValue& value, Bound bound) {
  if (value.IsScalar()) return {Distribution::Kind::fixed, value.Number(bound), 0};
  value.RequireKeys(Kinds());
  if (!IsDistribution(value)) value.RefuseValue("a number or one of uniform, log_uniform, normal");

  // of two numbers, by what they mean
  if (const auto normal = value.Find("normal")) return ReadNormal(*normal, bound);
  if (const auto range = value.Find("log_uniform")) {
    const auto [a, b] = range->Interval(Bound::positive);
    return {Distribution::Kind::log_uniform, a, b};
  }
  const auto [a, b] = value.Require("uniform", "give [lower, upper]").Interval(bound);
  return {Distribution::Kind::uniform, a, b};
}

std::string DistributionToYaml(const Distribution& distribution) {
  const auto [kind, a, b] = distribution;
  switch (kind) {
    case Distribution::Kind::fixed:
      return fmt::format("{}", a);
    case Distribution::Kind::uniform:
      return fmt::format("{{uniform: [{}, {}]}}", a, b);
    case Distribution::Kind::log_uniform:
      return fmt::format("{{log_uniform: [{}, {}]}}", a, b);
    case Distribution::Kind::normal:
      return fmt::format("{{normal: [{}, {}]}}", a, b);
  }
  return "";
}

}  // namespace warmjoint::inline scenarios

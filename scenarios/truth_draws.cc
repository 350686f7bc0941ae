#include "scenarios/truth_draws.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "models/foundation/data_folder.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/random_stream.h"
#include "models/foundation/serialize.h"
#include "models/friction/friction_json.h"
#include "scenarios/scenario.h"

namespace warmjoint {
namespace {

constexpr std::string_view kPrefix = "friction.";

/// Where the number of a drawn key stands in the friction.
Tree::json_pointer Pointer(const std::string& key) {
  std::string path = key.substr(kPrefix.size() - 1);
  std::replace(path.begin(), path.end(), '.', '/');
  return Tree::json_pointer(path);
}

double Middle(const Distribution& range) {
  return range.kind == Distribution::Kind::log_uniform ? std::sqrt(range.a * range.b)
                                                       : (range.a + range.b) / 2;
}

/// The value with distributions replaced by their middles and added to `draws`. key: dotted, from friction on.
Tree Middles(const Node& node, const std::string& key, TruthDraws& draws) {
  // a range stands for its middle until it is drawn
  if (IsDistribution(node)) {
    Distribution range;
    ReadValue(node, &range, {});
    if (range.kind == Distribution::Kind::normal) {
      node.RefuseValue("uniform or log_uniform, which keep a truth within its bounds");
    }
    draws.numbers[key] = range;
    return Middle(range);
  }
  if (node.IsMap()) {
    Tree map = Tree::object();
    for (const std::string& name : node.Keys()) {
      // names make dotted keys and paths
      if (name.empty() || name.find_first_of("./~") != std::string::npos) {
        Refuse(node.place(), "unknown key '{}' in {}: names hold no '.', '/' or '~'", Excerpt(name),
               Excerpt(node.key()));
      }
      const auto entry = node.Find(name);
      map[name] = entry ? Middles(*entry, fmt::format("{}.{}", key, name), draws) : Tree();
    }
    return map;
  }
  if (!node.IsList()) return node.tree();
  // entries of a list are known by their place in it
  Tree list = Tree::array();
  for (const Node& entry : node.Entries("a list")) {
    list.push_back(Middles(entry, fmt::format("{}.{}", key, list.size()), draws));
  }
  return list;
}

/// Refuses ranges whose ends the parameter tables do not allow.
void CheckEnds(const Node& middles, const TruthDraws& draws) {
  Tree lower = middles.tree(), upper = middles.tree();
  for (const auto& [key, range] : draws.numbers) {
    lower[Pointer(key)] = range.a;
    upper[Pointer(key)] = range.b;
  }
  FrictionFrom(middles.With(lower));
  FrictionFrom(middles.With(upper));
}

/// A path relative to the file that names it; a friction of the library as it is.
std::string PathIn(const Node& node) {
  if (IsOfLibrary(node.Text())) return node.Text();
  return std::filesystem::path(node.file()).parent_path() / node.Text();
}

void ReadEstimate(const Node& node, const Node& estimate, DrawnFriction& made) {
  node.RequireKeys({"estimate", "draw"});
  const std::string path = PathIn(estimate);
  made.friction = ReadFriction(path);
  if (const auto draw = node.Find("draw")) {
    if (draw->Text() != "posterior") draw->RefuseValue("posterior");
    made.draws.posterior = PosteriorOfEstimate(ReadJsonNode(path), made.friction);
  }
}

/// A friction of its draws. Throws BadInput where the posterior gives none within physical bounds.
Friction DrawFriction(const Scenario& scenario, RandomStream& random) {
  const TruthDraws& draws = scenario.draws;
  if (draws.posterior) return Draw(*draws.posterior, scenario.friction, random, {scenario.name});
  Tree tree = FrictionToTree(scenario.friction);
  for (const auto& [key, range] : draws.numbers) {
    if (key.starts_with(kPrefix)) tree[Pointer(key)] = range.Draw(random);
  }
  return FrictionFrom({std::move(tree), scenario.name});
}

}  // namespace

void ReadValue(const Node& node, DrawnFriction* value, const FieldInfo&) {
  *value = {};
  // a file, an estimate, or the friction itself
  if (node.IsScalar()) {
    value->friction = ReadFriction(PathIn(node));
    return;
  }
  if (const auto estimate = node.Find("estimate")) return ReadEstimate(node, *estimate, *value);

  // a posterior stands beside the friction, not in it
  TruthDraws& draws = value->draws;
  Tree tree = Middles(node, "friction", draws);
  if (tree.is_object()) tree.erase("posterior");
  const Node middles = node.With(std::move(tree));
  CheckEnds(middles, draws);
  value->friction = FrictionFrom(middles);
  const auto posterior = node.Find("posterior");
  if (!posterior) return;
  if (!draws.numbers.empty()) {
    Refuse(node.place(), "friction has a posterior and a distribution for {}; give one of them",
           draws.numbers.begin()->first);
  }
  draws.posterior = PosteriorFrom(*posterior, value->friction);
}

Tree WriteValue(const DrawnFriction& value) {
  Tree tree = FrictionToTree(value.friction);
  // drawn numbers as their ranges
  for (const auto& [key, range] : value.draws.numbers) tree[Pointer(key)] = WriteValue(range);
  if (value.draws.posterior) tree["posterior"] = WriteFields(*value.draws.posterior);
  return tree;
}

Scenario Realize(const Scenario& scenario, std::uint64_t realization) {
  Scenario realized = scenario;
  realized.draws = {};
  if (scenario.draws.empty()) return realized;

  // the same numbers for the same seed and realization
  RandomStream random({scenario.seed, realization}, Stream::truth);
  realized.friction = DrawFriction(scenario, random);
  const auto energy = scenario.draws.numbers.find(kInitialEnergy);
  if (energy != scenario.draws.numbers.end()) realized.initial_energy = energy->second.Draw(random);
  return realized;
}

}  // namespace warmjoint

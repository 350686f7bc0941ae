#include "models/friction/friction_json.h"

#include <nlohmann/json.hpp>

#include "models/foundation/serialize.h"
#include "models/friction/check_friction.h"

namespace warmjoint {

Tree FrictionToTree(const Friction& friction) { return WriteFields(friction); }

Friction FrictionFrom(const Node& node) {
  Friction friction;
  ReadFields(node.With(UnknownKeys::refused), &friction);
  return Completed(std::move(friction), node.place());
}

void ReadValue(const Node& node, Friction* value, const FieldInfo&) { *value = FrictionFrom(node); }

Tree MapsToTree(const std::vector<FrictionMap>& maps) { return WriteValue(maps); }

std::vector<FrictionMap> MapsFrom(const Node& node) {
  std::vector<FrictionMap> maps;
  ReadValue(node, &maps, {});
  for (const FrictionMap& map : maps) CheckMap(map, node.place());
  return maps;
}

void RefuseAmperes(const Friction& friction, const Place& place) {
  if (friction.torque_unit.empty()) return;
  Refuse(place,
         "its friction is in {}, and a simulator needs torque: identify again with "
         "--torque-constant, the torque of the joint for each ampere",
         friction.torque_unit);
}

std::string FrictionToJson(const Friction& friction) {
  return FrictionToTree(Completed(friction, {"friction"})).dump(2) + "\n";
}

Friction FrictionFromJson(const std::string& text, const std::string& name) {
  return FrictionFrom(ParseJsonNode(text, name));
}

Friction ReadFriction(const std::filesystem::path& path) {
  const Node file = ReadJsonNode(path);
  // an estimate holds its friction under that name; else the file is one
  Friction friction = FrictionFrom(file.Find("friction").value_or(file));
  RefuseAmperes(friction, {path});
  return friction;
}

}  // namespace warmjoint

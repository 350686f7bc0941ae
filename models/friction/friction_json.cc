#include "models/friction/friction_json.h"

#include <nlohmann/json.hpp>

#include "models/foundation/serialize.h"
#include "models/friction/check_friction.h"

namespace warmjoint::inline models {

Tree FrictionToTree(const FrictionDescription& friction) { return WriteFields(friction); }

FrictionDescription FrictionFrom(const Node& node) {
  FrictionDescription friction;
  ReadFields(node.With(UnknownKeys::refused), &friction);
  // what was left out, then all of it together
  FillDefaults(friction);
  CheckFriction(friction, node.place());
  return friction;
}

void ReadValue(const Node& node, FrictionDescription* value, const FieldInfo&) {
  *value = FrictionFrom(node);
}

Tree MapsToTree(const std::vector<FrictionMap>& maps) { return WriteValue(maps); }

std::vector<FrictionMap> MapsFrom(const Node& node) {
  std::vector<FrictionMap> maps;
  ReadValue(node, &maps, {});
  for (const FrictionMap& map : maps) CheckMap(map, node.place());
  return maps;
}

void RefuseAmperes(const FrictionDescription& friction, const Place& place) {
  if (friction.torque_unit.empty()) return;
  Refuse(place,
         "its friction is in {}, and a simulator needs torque: identify again with "
         "--torque-constant, the torque of the joint for each ampere",
         friction.torque_unit);
}

FrictionDescription ReadFrictionFile(const std::string& path) {
  const Node file = ReadJsonNode(path);
  // an estimate holds its friction under that name; else the file is one
  FrictionDescription friction = FrictionFrom(file.Find("friction").value_or(file));
  RefuseAmperes(friction, {path});
  return friction;
}

}  // namespace warmjoint::inline models

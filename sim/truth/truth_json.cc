#include "sim/truth/truth_json.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "models/foundation/atomic_file.h"
#include "models/foundation/json_members.h"
#include "models/foundation/json_turn.h"
#include "models/foundation/read_json.h"
#include "models/friction/friction_json.h"

namespace warmjoint::inline sim {
namespace {

using nlohmann::json;

constexpr std::pair<const char*, Eigen::VectorXd Truth::*> kArrays[] = {
    {"velocity", &Truth::velocity},
    {"force", &Truth::force},
    {"loss", &Truth::loss},
    {"energy", &Truth::energy},
};

void CheckKeys(const json& object, const Place& place) {
  // colour of the noise is there where it has any
  static const std::vector<std::string> needed{
      "friction", "initial_energy", "torque_noise", "plant", "velocity", "force", "loss", "energy"};
  std::vector<std::string> known = needed;
  known.insert(known.end(), {"coloured_noise", "correlation_time"});
  // an object of known keys, with all that are needed
  if (!object.is_object()) Refuse(place, "holds no object; a truth file is one");
  RefuseUnknownKeys(object, "truth", known, place);
  for (const std::string& key : needed) {
    if (!object.contains(key)) Refuse(place, "lacks '{}'; is it a truth file?", key);
  }
}

template <typename T>
T Member(const json& object, const char* key, const char* kind, const Place& place) {
  try {
    return object.at(key).get<T>();
  } catch (const json::exception&) {
    Refuse(place, "{} must be {}", key, kind);
  }
}

}  // namespace

json TruthToJson(const Truth& truth) {
  // friction, start and noise
  json result{{"friction", FrictionToJson(truth.friction)},
              {"initial_energy", truth.initial_energy},
              {"torque_noise", truth.torque_noise},
              {"plant", truth.plant}};
  if (truth.correlation_time > 0) {
    result["coloured_noise"] = truth.coloured_noise;
    result["correlation_time"] = truth.correlation_time;
  }
  // columns of N samples each
  for (const auto& [key, array] : kArrays) result[key] = truth.*array;
  return result;
}

Truth TruthFromJson(const json& object, const Place& place) {
  // friction, start and noise
  CheckKeys(object, place);
  Truth truth;
  truth.friction = FrictionFromJson(object["friction"], place);
  truth.initial_energy = Member<double>(object, "initial_energy", "a number", place);
  truth.torque_noise = Member<double>(object, "torque_noise", "a number", place);
  if (object.contains("correlation_time")) {
    truth.correlation_time = Member<double>(object, "correlation_time", "a number", place);
  }
  if (object.contains("coloured_noise")) {
    truth.coloured_noise = Member<double>(object, "coloured_noise", "a number", place);
  }

  // which plant, and columns of one length
  truth.plant = Member<std::string>(object, "plant", "text", place);

  for (const auto& [key, array] : kArrays) {
    const auto values = Member<std::vector<double>>(object, key, "an array of numbers", place);
    truth.*array =
        Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
    if ((truth.*array).size() == truth.velocity.size()) continue;
    Refuse(place, "{} has {} samples where velocity has {}; all arrays must be of one length", key,
           values.size(), truth.velocity.size());
  }
  return truth;
}

void WriteTruth(const Truth& truth, const std::string& path) {
  const nlohmann::json json = TruthToJson(truth);
  // one thread at a time: the writer asks for the locale
  const auto written = [&] {
    const auto turn = JsonTurn();
    return json.dump() + "\n";
  };
  WriteWholeFile(path, written());
}

Truth ReadTruth(const std::string& path) { return TruthFromJson(ReadJsonFile(path), {path}); }

}  // namespace warmjoint::inline sim

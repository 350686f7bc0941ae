#include "identification/gravity_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"

namespace warmjoint::inline identification {
namespace {

constexpr std::array kKinds{GravityKind::sincos, GravityKind::paired, GravityKind::constant};

double NumberOf(const nlohmann::json& from, const char* key, const Place& place) {
  const auto found = from.find(key);
  if (found == from.end() || !found->is_number()) {
    Refuse(place, "gravity: {} must be a number", key);
  }
  return found->get<double>();
}

std::vector<double> NumbersOf(const nlohmann::json& from, const char* key, const Place& place) {
  const auto found = from.find(key);
  const bool numbers =
      found != from.end() && found->is_array() &&
      std::all_of(found->begin(), found->end(), [](const auto& one) { return one.is_number(); });
  if (!numbers) Refuse(place, "gravity: {} must be a list of numbers", key);
  return found->get<std::vector<double>>();
}

GravityKind KindOf(const nlohmann::json& from, const Place& place) {
  const std::string name =
      from.is_object() && from.contains("kind") && from["kind"].is_string() ? from["kind"] : "";
  std::vector<std::string> known;
  for (const GravityKind kind : kKinds) {
    if (name == GravityName(kind)) return kind;
    known.emplace_back(GravityName(kind));
  }
  Refuse(place, "gravity has no kind '{}'{}", Excerpt(name), Suggestion(name, known));
}

}  // namespace

nlohmann::json GravityToJson(const GravityModel& gravity) {
  nlohmann::json json{{"kind", GravityName(gravity.kind)}};
  switch (gravity.kind) {
    case GravityKind::sincos:
      json["sine"] = gravity.values[0];
      json["cosine"] = gravity.values[1];
      break;
    case GravityKind::constant:
      json["offset"] = gravity.values[0];
      break;
    case GravityKind::paired:
      for (const int knot : gravity.knots) json["position"].push_back(knot * kKnotSpacing);
      for (const double value : gravity.values) json["torque"].push_back(value);
  }
  return json;
}

GravityModel GravityFromJson(const nlohmann::json& json, const Place& place) {
  GravityModel gravity;
  gravity.kind = KindOf(json, place);
  // the kinds with a fixed number of coefficients
  if (gravity.kind == GravityKind::sincos) {
    gravity.values =
        Eigen::Vector2d(NumberOf(json, "sine", place), NumberOf(json, "cosine", place));
    return gravity;
  }
  if (gravity.kind == GravityKind::constant) {
    gravity.values = Eigen::VectorXd::Constant(1, NumberOf(json, "offset", place));
    return gravity;
  }

  // knots by their positions
  const std::vector<double> position = NumbersOf(json, "position", place);
  const std::vector<double> torque = NumbersOf(json, "torque", place);
  if (position.size() != torque.size()) {
    Refuse(place, "gravity has {} positions and {} torques; give as many of each", position.size(),
           torque.size());
  }
  if (position.empty()) Refuse(place, "gravity has no positions; give its knots, or leave it out");
  // multiples of the spacing within one turn, ascending
  for (const double p : position) {
    const auto knot = static_cast<int>(std::lround(p / kKnotSpacing));
    const bool ascends = gravity.knots.empty() || knot > gravity.knots.back();
    if (!(std::abs(p - knot * kKnotSpacing) < 1e-6) || knot < 0 || knot >= kGravityKnots ||
        !ascends) {
      Refuse(place, "gravity: position {} is not a knot; they ascend by multiples of {} rad", p,
             kKnotSpacing);
    }
    gravity.knots.push_back(knot);
  }
  // torque at the knots
  gravity.values = Eigen::Map<const Eigen::VectorXd>(torque.data(), torque.size());
  return gravity;
}

}  // namespace warmjoint::inline identification

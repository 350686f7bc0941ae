#include "identification/gravity.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"

namespace warmjoint::inline identification {
namespace {

constexpr double kSpacing = 2 * std::numbers::pi / kGravityKnots;  // rad
constexpr std::array kKinds{GravityKind::sincos, GravityKind::paired, GravityKind::constant};

/// The knot at or below a position, and the share of the way to the next.
std::pair<int, double> Below(double position) {
  const double cells = position / kSpacing;
  const double whole = std::floor(cells);
  const int knot = static_cast<int>(std::fmod(whole, kGravityKnots));
  // on one turn, also for positions below 0
  return {(knot + kGravityKnots) % kGravityKnots, cells - whole};
}

/// Index of a knot among those known, or -1.
Eigen::Index IndexOf(const std::vector<int>& knots, int knot) {
  const auto found = std::lower_bound(knots.begin(), knots.end(), knot % kGravityKnots);
  return found != knots.end() && *found == knot % kGravityKnots ? found - knots.begin() : -1;
}

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

std::string_view GravityName(GravityKind kind) {
  switch (kind) {
    case GravityKind::sincos:
      return "sincos";
    case GravityKind::paired:
      return "paired";
    case GravityKind::constant:
      return "constant";
  }
  return "";
}

bool GravityModel::Covers(double position) const {
  if (kind != GravityKind::paired) return true;
  const int below = Below(position).first;
  return IndexOf(knots, below) >= 0 && IndexOf(knots, below + 1) >= 0;
}

Eigen::VectorXd GravityModel::Torque(const Eigen::VectorXd& position) const {
  return GravityColumns(kind, knots, position) * values;
}

Eigen::MatrixXd GravityColumns(GravityKind kind, const std::vector<int>& knots,
                               const Eigen::VectorXd& position) {
  const Eigen::Index n = position.size();
  if (kind == GravityKind::constant) return Eigen::MatrixXd::Ones(n, 1);
  if (kind == GravityKind::sincos) {
    Eigen::MatrixXd columns(n, 2);
    columns << position.array().sin(), position.array().cos();
    return columns;
  }

  // a hat over each knot
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(knots.size()));
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto [knot, share] = Below(position[i]);
    const Eigen::Index below = IndexOf(knots, knot), above = IndexOf(knots, knot + 1);
    // beside a knot that is missing nothing is known of the torque
    if (below < 0 || above < 0) continue;
    columns(i, below) += 1 - share;
    columns(i, above) += share;
  }
  return columns;
}

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
      for (const int knot : gravity.knots) json["position"].push_back(knot * kSpacing);
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
    const auto knot = static_cast<int>(std::lround(p / kSpacing));
    const bool ascends = gravity.knots.empty() || knot > gravity.knots.back();
    if (!(std::abs(p - knot * kSpacing) < 1e-6) || knot < 0 || knot >= kGravityKnots || !ascends) {
      Refuse(place, "gravity: position {} is not a knot; they ascend by multiples of {} rad", p,
             kSpacing);
    }
    gravity.knots.push_back(knot);
  }
  // torque at the knots
  gravity.values = Eigen::Map<const Eigen::VectorXd>(torque.data(), torque.size());
  return gravity;
}

}  // namespace warmjoint::inline identification

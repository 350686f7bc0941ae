#include "identification/gravity.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "models/foundation/serialize.h"

namespace warmjoint {
namespace {

/// Index of a knot among those known, or -1.
Eigen::Index IndexOf(const std::vector<int>& knots, int knot) {
  const auto found = std::lower_bound(knots.begin(), knots.end(), knot % kGravityKnots);
  return found != knots.end() && *found == knot % kGravityKnots ? found - knots.begin() : -1;
}

/// Gravity as files have it: the members of its kind.
struct GravityFields {
  GravityKind kind = GravityKind::sincos;
  std::optional<double> sine, cosine, offset;
  std::vector<double> position, torque;

  template <class A>
  void Serialize(A* a) {
    constexpr auto left_out = AtDefault::left_out;
    a->Field("kind", &kind, {.needed = "say sincos, paired or constant"});
    a->Field("sine", &sine, {.unit = "N.m"});
    a->Field("cosine", &cosine, {.unit = "N.m"});
    a->Field("offset", &offset, {.unit = "N.m"});
    a->Field("position", &position, {.unit = "rad", .at_default = left_out});
    a->Field("torque", &torque, {.unit = "N.m", .at_default = left_out});
    // the members that a kind needs
    const bool sincos = kind == GravityKind::sincos, paired = kind == GravityKind::paired;
    a->Require(sincos, "sine", kGiveNumber);
    a->Require(sincos, "cosine", kGiveNumber);
    a->Require(kind == GravityKind::constant, "offset", kGiveNumber);
    a->Require(paired, "position", "give the knots, or leave gravity out");
    a->Check(position.size() == torque.size() && !(paired && position.empty()), "torque",
             "as long as position, with one at least");
  }
};

/// Knots by their positions: multiples of the spacing within one turn, ascending.
std::vector<int> KnotsAt(const std::vector<double>& position, const Place& place) {
  std::vector<int> knots;
  for (const double p : position) {
    const auto knot = static_cast<int>(std::lround(std::clamp(p / kKnotSpacing, -1.0, 1e3)));
    const bool ascends = knots.empty() || knot > knots.back();
    if (!(std::abs(p - knot * kKnotSpacing) < 1e-6) || knot < 0 || knot >= kGravityKnots ||
        !ascends) {
      Refuse(place, "gravity: position {} is not a knot; they ascend by multiples of {} rad", p,
             kKnotSpacing);
    }
    knots.push_back(knot);
  }
  return knots;
}

}  // namespace

int CellOf(double position) {
  const auto cell = static_cast<int>(std::fmod(std::floor(position / kKnotSpacing), kGravityKnots));
  // on one turn, also for positions below 0
  return (cell + kGravityKnots) % kGravityKnots;
}

bool GravityModel::Covers(double position) const {
  if (kind != GravityKind::paired) return true;
  const int below = CellOf(position);
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
    const int knot = CellOf(position[i]);
    const double cells = position[i] / kKnotSpacing, share = cells - std::floor(cells);
    const Eigen::Index below = IndexOf(knots, knot), above = IndexOf(knots, knot + 1);
    // next to a knot that is missing nothing is known of the torque
    if (below < 0 || above < 0) continue;
    columns(i, below) += 1 - share;
    columns(i, above) += share;
  }
  return columns;
}

void ReadValue(const Node& node, GravityModel* value, const FieldInfo&) {
  const auto fields = ReadAs<GravityFields>(node);
  value->kind = fields.kind;
  if (fields.kind == GravityKind::sincos) {
    value->values = Eigen::Vector2d(*fields.sine, *fields.cosine);
  } else if (fields.kind == GravityKind::constant) {
    value->values = Eigen::VectorXd::Constant(1, *fields.offset);
  } else {
    value->knots = KnotsAt(fields.position, node.place());
    value->values = Eigen::Map<const Eigen::VectorXd>(
        fields.torque.data(), static_cast<Eigen::Index>(fields.torque.size()));
  }
}

Tree WriteValue(const GravityModel& value) {
  GravityFields fields;
  fields.kind = value.kind;
  if (value.kind == GravityKind::sincos) {
    fields.sine = value.values[0];
    fields.cosine = value.values[1];
  } else if (value.kind == GravityKind::constant) {
    fields.offset = value.values[0];
  } else {
    for (const int knot : value.knots) fields.position.push_back(knot * kKnotSpacing);
    fields.torque.assign(value.values.begin(), value.values.end());
  }
  return WriteFields(fields);
}

}  // namespace warmjoint

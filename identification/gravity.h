// Gravity along a joint, G(p) of Eq. (6), as identification finds it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <numbers>
#include <span>
#include <string_view>
#include <vector>

#include "models/foundation/node.h"

namespace warmjoint::inline identification {

/// How G depends on the position p, linear in its values g:
///   sincos    g1 sin p + g2 cos p, rotary joints
///   paired    any periodic G(p), rotary joints: straight lines between 64 knots on the turn
///   constant  g1: what `paired` is for a linear joint, whose weight does not depend on p
enum class GravityKind { sincos, paired, constant };

inline std::span<const Word<GravityKind>> WordsOf(GravityKind) {
  static constexpr std::array words{Word{"sincos", GravityKind::sincos},
                                    Word{"paired", GravityKind::paired},
                                    Word{"constant", GravityKind::constant}};
  return words;
}

inline constexpr int kGravityKnots = 64;  // on a turn; a line misses g sin p by g (2 pi/64)^2/8
inline constexpr double kKnotSpacing = 2 * std::numbers::pi / kGravityKnots;  // rad

/// Gravity with its values.
struct GravityModel {
  GravityKind kind = GravityKind::sincos;
  std::vector<int> knots;  // paired: [m] those that are known, ascending; knot i: 2 pi i/64 rad
  Eigen::VectorXd values;  // sincos: [2]; paired: [m] torque at the knots; constant: [1]. N.m or N

  /// Whether G is known at a position (rad or m): paired knows it between neighbouring knots.
  bool Covers(double position) const;

  /// G at positions that are covered. position: [N] rad or m; returns [N] N.m or N.
  Eigen::VectorXd Torque(const Eigen::VectorXd& position) const;
};

/// {kind, sine, cosine}, {kind, position[] (rad), torque[]} or {kind, offset}; N.m or N. Throws BadInput.
void ReadValue(const Node& node, GravityModel* value, const FieldInfo& info);
Tree WriteValue(const GravityModel& value);

/// dG/dg at each position, one column for each value. A position beside the knots has zeros.
/// position: [N] rad or m; returns [N x m].
Eigen::MatrixXd GravityColumns(GravityKind kind, const std::vector<int>& knots,
                               const Eigen::VectorXd& position);

}  // namespace warmjoint::inline identification

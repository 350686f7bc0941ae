// Of fields: what they hold, and why a fit has none.
#pragma once

#include <warmjoint/fields.h>

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace warmjoint {

/// How much a field holds.
struct FieldShare {
  FieldKind kind = FieldKind::place_torque;
  double share = 0;  // rms, of the friction
};
/// The clause about what fields hold. left_out: the most that the friction file leaves out of it along the log, a share of the friction
std::string SummaryOfFields(const std::vector<FieldShare>& shares, double left_out);

// why a fit that was asked for fields has none
inline constexpr const char* kNoFieldsBesideMaps =
    "no fields are fitted, since its maps take their place; leave fields out, or choose an "
    "identifier without maps";
inline constexpr const char* kNoFieldsBesideLag =
    "no fields are fitted with a lag of the torque or another loss than squares; leave one of them "
    "out";
inline constexpr const char* kNoFieldsBesideCovariance =
    "no fields are fitted, since this fit has errors of its own; use nominal-ls";
/// The log is too short. rows: means over 40 ms that there are
inline constexpr const char* kFrictionFalls =
    "friction falls with speed: viscous friction is held at 0, Coulomb friction is that at the "
    "median speed, and the fall is in the friction at speeds and in the map over the velocity";
/// The sentence about figures of a friction that changes over the log. drift: rms about its mean, of the friction
std::string ExplainMeansOverLog(double drift);
/// Of one that changes with a temperature. slope: N.m/K or N/K
std::string ExplainTemperature(double slope, std::string_view torque_unit);
std::string ExplainFewFieldRows(Eigen::Index rows, Eigen::Index fewest);

}  // namespace warmjoint

#include "identification/lack_of_fit/other_units.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace warmjoint {
namespace {

constexpr double kDegree = std::numbers::pi / 180;  // rad
constexpr double kClock = 1.01;  // as fast as it should be; why: the slip that is asked about

/// The most that an end of each interval moves. [p]
Eigen::VectorXd FarthestMoves(double way, double time, const Fit& fit, const Inference& inference,
                              const std::vector<size_t>& rows) {
  Eigen::VectorXd moves(static_cast<Eigen::Index>(rows.size()));
  for (size_t i = 0; i < rows.size(); ++i) {
    const FitParameter& parameter = fit.parameters[rows[i]];
    const ParameterInterval& known = inference.parameters[rows[i]];
    const double factor = std::pow(way, parameter.way_power) * std::pow(time, parameter.time_power);
    // the end of the interval that is farther from 0 moves most
    const double farthest = std::abs(known.value) + known.HalfWidth();
    moves[static_cast<Eigen::Index>(i)] = (factor - 1) * std::copysign(farthest, known.value);
  }
  return moves;
}

}  // namespace

void AddOtherUnits(const Fit& fit, const Inference& inference, JointKind joint,
                   Examination& examination) {
  if (joint == JointKind::rotary) {
    examination.Add(Source::degrees, Action::note,
                    FarthestMoves(kDegree, 1, fit, inference, examination.rows));
  }
  examination.Add(Source::clock, Action::note,
                  FarthestMoves(1, kClock, fit, inference, examination.rows));
}

}  // namespace warmjoint

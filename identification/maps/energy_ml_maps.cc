#include "identification/maps/energy_ml_maps.h"

#include <fmt/format.h>
#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "identification/fit/seen_samples.h"
#include "identification/maps/local_rows.h"
#include "identification/maps/map_model.h"
#include "identification/sentences/maps.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

constexpr int kAngles = 256;
// why: a chi-square of 2 degrees of freedom exceeds 23 by chance once in 100 000 times
constexpr double kChance = 23;

/// The grid of angles and speeds of one direction of motion, over which the map is averaged.
MapPoints Grid(const FrictionMap& map, int direction) {
  // speeds of the map in this direction; one where it has none
  std::vector<double> speeds;
  if (const MapAxis* axis = FindAxis(map, MapQuantity::velocity)) {
    for (const double centre : axis->kernels.centres) {
      if ((centre > 0) == (direction == 1)) speeds.push_back(centre);
    }
  }
  if (speeds.empty()) speeds.push_back(direction == 1 ? 1 : -1);
  const auto count = static_cast<Eigen::Index>(speeds.size());
  // a whole turn at each of them
  MapPoints points = MapPoints::Zero(kAngles * count, 5);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const double turn = static_cast<double>(i / count) / kAngles;
    points(i, static_cast<int>(MapQuantity::motor_position)) = 2 * std::numbers::pi * turn;
    points(i, static_cast<int>(MapQuantity::velocity)) = speeds[i % count];
  }
  return points;
}

/// Harmonics a cos(multiple motor angle - phase) of a map whose first axis is the motor position, its mean over the other
/// axes in a direction of motion, 0 for v < 0, 1 for v > 0: those multiples of 1 to half its kernels that exceed the
/// noise, each with a, N.m or N, and are at least a fifth of the strongest; strongest first. covariance: [q x q] of the
/// weights.
std::vector<std::pair<int, double>> DominantHarmonics(const FrictionMap& map,
                                                      const Eigen::MatrixXd& covariance,
                                                      int direction) {
  // kernels on the grid, over which sums are Fourier coefficients
  const MapPoints points = Grid(map, direction);
  const Eigen::MatrixXd kernels = DenseKernels({map}, points, 0, points.rows());
  const Eigen::Map<const Eigen::VectorXd> weights(map.weights.data(), kernels.cols());
  const Eigen::ArrayXd angle = points.col(static_cast<int>(MapQuantity::motor_position));
  const double scale = 2 / static_cast<double>(points.rows());

  std::vector<std::pair<int, double>> harmonics;
  const auto highest = static_cast<int>(map.axes.front().kernels.size() / 2);
  for (int k = 1; k <= highest; ++k) {
    // both parts as linear functions of the weights
    Eigen::MatrixXd parts(2, kernels.cols());
    parts.row(0) = scale * (k * angle).cos().matrix().transpose() * kernels;
    parts.row(1) = scale * (k * angle).sin().matrix().transpose() * kernels;
    const Eigen::Vector2d z = parts * weights;
    const Eigen::Matrix2d spread = parts * covariance * parts.transpose();
    if (z.dot(spread.inverse() * z) > kChance) harmonics.emplace_back(k, z.norm());
  }
  std::ranges::stable_sort(harmonics, std::ranges::greater{}, &std::pair<int, double>::second);
  const double largest = harmonics.empty() ? 0 : harmonics.front().second;
  std::erase_if(harmonics, [=](const auto& one) { return one.second < 0.2 * largest; });
  return harmonics;
}

constexpr double kTurn = 2 * std::numbers::pi;  // rad
constexpr double kKernelsATurn = 3;             // why: mean, cosine and sine of one turn

/// The joint's map: over its travel, or over one turn.
FrictionMap ArmMap(const MotorMapSize& size, const MapOptions& settings, JointKind joint,
                   double width, const MapPoints& points) {
  FrictionMap map = PositionMap(points, settings.kernel, size.arm, width);
  const double travel = map.axes[0].kernels.centres.back() - map.axes[0].kernels.centres.front();
  if (joint == JointKind::rotary && size.arm * kTurn < kKernelsATurn * travel) {
    map.axes[0] = TurnAxis(MapQuantity::position, size.arm, width);
  }
  return map;
}

/// Kernels over the joint's position in addition to the motor's map where none are asked for.
constexpr int kArmKernels = 20;

/// What a law with a map over position, or over the motor's angle, is fitted to.
MapModel ModelOf(const IdentifierInput& input) {
  const auto& maps = input.options.Get<WarmMapOptions>();
  if (maps.position == WarmMap::map) {
    return {.quantities = {MapQuantity::position},
            .maps = [&](const MapPoints& points) { return PositionMaps(input.options, points); },
            .heat = MapHeat::estimated};
  }
  const MotorMapSize size{maps.motor_kernels, maps.velocity_kernels,
                          maps.kernels > 0 ? maps.kernels : kArmKernels};
  return {.quantities = {MapQuantity::position, MapQuantity::motor_position},
          .maps =
              [&, size](const MapPoints& points) {
                return MotorMaps(size, input.options.Get<MapOptions>(), input.measurements.joint,
                                 points);
              },
          .heat = MapHeat::estimated};
}

}  // namespace

MapShapes MotorMaps(const MotorMapSize& size, const MapOptions& settings, JointKind joint,
                    const MapPoints& points) {
  // a map over the motor's turn and speed, and one over the arm where asked for
  return ForEachWidth(settings, [&](double width) {
    std::vector<FrictionMap> maps{{{TurnAxis(MapQuantity::motor_position, size.turn, width),
                                    VelocityAxis(points, size.speed, width)},
                                   settings.kernel,
                                   {}}};
    if (size.arm > 0) maps.push_back(ArmMap(size, settings, joint, width, points));
    return maps;
  });
}

void DescribeMotorRipple(const FrictionMap& motor, const Eigen::MatrixXd& covariance,
                         const LogSamples& measurements, Fit& fit) {
  for (const int direction : {1, 0}) {
    const auto found = DominantHarmonics(motor, covariance, direction);
    fit.causes.push_back(Note(ExplainMotorRipple(direction == 1, found, measurements.torque_unit),
                              SentenceIn::message));
  }
  if (!KnowsMotorAngle(measurements)) fit.causes.push_back(Note(kMotorTurnsWithJoint));
}

Fit FitWithMaps(const std::string& identifier, const IdentifierInput& input) {
  // maps are fitted by squares only
  const LossKind loss = input.options.Get<LossOption>().loss;
  if (loss != LossKind::squares) {
    return Refused(
        identifier, Status::bad_data,
        ExplainMapBesideLoss(NameOf(input.options.Get<WarmMapOptions>().position), NameOf(loss)));
  }
  return FitMapModel(identifier, input, ModelOf(input));
}

std::optional<ChosenMap> MapGivenEnergy(const IdentifierInput& given,
                                        const Eigen::VectorXd& energy) {
  MapBeginning begin = BeginModel("", given, ModelOf(given));
  if (begin.refusal) return std::nullopt;
  // shape and strength of the map, given the energy
  begin.task.energy = energy;
  const auto chosen = Choose(begin.task.rigid.Of(given), begin.task);
  if (!chosen) return std::nullopt;
  return ChosenMap{chosen->problem.maps.front(), chosen->strength};
}

}  // namespace warmjoint

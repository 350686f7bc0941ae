#include "identification/maps/energy_ml_maps.h"

#include <fmt/format.h>

#include "identification/maps/map_model.h"
#include "identification/maps/motor_maps.h"
#include "identification/seen_samples.h"

namespace warmjoint {
namespace {

/// Kernels over the joint's position beside the motor's map where none are asked for.
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

Fit FitWithMaps(const std::string& identifier, const IdentifierInput& input) {
  // maps know squares alone
  const LossKind loss = input.options.Get<LossOption>().loss;
  if (loss != LossKind::squares) {
    return Refused(
        identifier, Status::bad_data,
        fmt::format("position={} cannot be had together with loss={}; leave one of them out",
                    NameOf(input.options.Get<WarmMapOptions>().position), NameOf(loss)));
  }
  return FitMapModel(identifier, input, ModelOf(input));
}

std::optional<ChosenMap> MapGivenEnergy(const IdentifierInput& given,
                                        const Eigen::VectorXd& energy) {
  MapBeginning begin = BeginModel("", given, ModelOf(given));
  if (begin.refusal) return std::nullopt;
  // shape and strength of the map beside an energy that is known
  begin.task.energy = energy;
  const auto chosen = Choose(begin.task.rigid.Of(given), begin.task);
  if (!chosen) return std::nullopt;
  return ChosenMap{chosen->problem.maps.front(), chosen->strength};
}

}  // namespace warmjoint

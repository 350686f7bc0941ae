#include "identification/maps/energy_ml_maps.h"

#include <fmt/format.h>

#include "identification/fit_data.h"
#include "identification/inference/inference.h"
#include "identification/linear/robust.h"
#include "identification/maps/motor_maps.h"
#include "identification/maps/warm_maps.h"
#include "identification/seen_samples.h"
#include "identification/warming/expected_start.h"

namespace warmjoint {
namespace {

/// Kernels over the joint's position beside the motor's map where none are asked for.
constexpr int kArmKernels = 20;

/// What a law with a map over position, or over the motor's angle, begins with.
MapBeginning Begin(const std::string& identifier, const IdentifierInput& input,
                   const RigidPart& rigid) {
  if (input.options.Get<WarmMapOptions>().position == WarmMap::map) {
    return BeginMaps(input, identifier, {MapQuantity::position}, rigid);
  }
  return BeginMaps(input, identifier, {MapQuantity::position, MapQuantity::motor_position}, rigid);
}

/// The shapes that the option `position` names.
std::vector<std::vector<FrictionMap>> Candidates(const Options& options, JointKind joint,
                                                 const MapBeginning& begin) {
  const auto& maps = options.Get<WarmMapOptions>();
  if (maps.position == WarmMap::map) return PositionMaps(options, begin.points);
  return MotorMaps(
      {maps.motor_kernels, maps.velocity_kernels, maps.kernels > 0 ? maps.kernels : kArmKernels},
      begin.task.settings, joint, begin.points);
}

/// What a log that knows nothing of its start says of one that was expected: the fit that takes E(0)
/// from the log, where that contradicts; else nothing.
std::optional<Fit> AgainstExpected(const IdentifierInput& input, const MapTask& task,
                                   const InitialEnergy& expected) {
  // law, maps and warming with an E(0) that the log alone tells
  const auto alone = FitWarmMaps(input, task, InitialEnergy::estimated);
  if (!alone || !alone->converged) return std::nullopt;
  Fit fit = AsFit(input, *alone);
  if (fit.refusal) return std::nullopt;
  const size_t row = *fit.RowOf(Role::start);
  const ParameterInterval found = Infer(fit).parameters[row];
  if (!found.std) return std::nullopt;
  // whether both E(0) contradict each other
  const std::string unlike = UnlikeBefore(expected, found.value, *found.std);
  if (unlike.empty()) return std::nullopt;
  fit.warnings.push_back(unlike);
  return fit;
}

}  // namespace

Fit FitWithMaps(const std::string& identifier, const IdentifierInput& given) {
  // gravity and inertia, where they are asked for, and what a map needs
  const RigidPart rigid = PrepareRigid(given);
  if (rigid.why) return Refused(identifier, {rigid.status, *rigid.why});
  const IdentifierInput input = rigid.Of(given);
  MapBeginning begin = Begin(identifier, input, rigid);
  if (begin.refusal) return Refused(identifier, *begin.refusal);
  // maps know squares alone
  const LossKind loss = input.options.Get<LossOption>().loss;
  if (loss != LossKind::squares) {
    return Refused(
        identifier, Status::bad_data,
        fmt::format("position={} cannot be had together with loss={}; leave one of them out",
                    NameOf(input.options.Get<WarmMapOptions>().position), NameOf(loss)));
  }
  // an expected start first, unless the log contradicts it
  begin.task.candidates = Candidates(input.options, input.measurements.joint, begin);
  const InitialEnergy initial = InitialEnergyOf(input.options);
  if (initial.is_expected()) {
    if (auto unlike = AgainstExpected(input, begin.task, initial)) return *unlike;
  }
  const std::optional<WarmMaps> warm = FitWarmMaps(input, begin.task, initial);
  return warm ? AsFit(input, *warm) : Refused(identifier, Unsolvable());
}

std::optional<ChosenMap> MapBesideEnergy(const IdentifierInput& given,
                                         const Eigen::VectorXd& energy) {
  const RigidPart rigid = PrepareRigid(given);
  if (rigid.why) return std::nullopt;
  const IdentifierInput input = rigid.Of(given);
  MapBeginning begin = Begin("", input, rigid);
  if (begin.refusal) return std::nullopt;
  // shape and strength of the map beside a course of the energy that is known
  begin.task.candidates = Candidates(input.options, input.measurements.joint, begin);
  begin.task.energy = energy;
  const auto chosen = Choose(input, begin.task);
  if (!chosen) return std::nullopt;
  return ChosenMap{chosen->problem.maps.front(), chosen->strength};
}

}  // namespace warmjoint

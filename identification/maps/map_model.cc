#include "identification/maps/map_model.h"

#include <optional>

#include "identification/explain.h"
#include "identification/inference/inference.h"
#include "identification/maps/warm_maps.h"
#include "identification/physical_bounds.h"
#include "identification/warming/expected_start.h"

namespace warmjoint {
namespace {

/// Law and maps without heat.
Fit FitCold(const IdentifierInput& input, const MapTask& task) {
  auto choice = ChooseAndFit(input, task);
  if (!choice) return Refused(task.identifier, Unsolvable());
  if (task.settings.bands == MapBands::none) return AsSketch(input, task, std::move(*choice));
  return AsFit(input, task, choice->fit, MapCovariance(choice->problem, choice->fit));
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
  const std::string unlike = ContradictsExpected(expected, found.value, *found.std);
  if (unlike.empty()) return std::nullopt;
  fit.causes.push_back(Remark(unlike));
  return fit;
}

/// Law, maps and heat.
Fit FitWarm(const IdentifierInput& input, const MapTask& task) {
  // an expected start first, unless the log contradicts it
  const bool knows_start = input.options.Find<InitialEnergyOptions>() != nullptr;
  const InitialEnergy initial = knows_start ? InitialEnergyOf(input.options) : InitialEnergy::zero;
  if (initial.is_expected()) {
    if (auto unlike = AgainstExpected(input, task, initial)) return *unlike;
  }
  const std::optional<WarmMaps> warm = FitWarmMaps(input, task, initial);
  return warm ? AsFit(input, *warm) : Refused(task.identifier, Unsolvable());
}

}  // namespace

MapBeginning BeginModel(const std::string& name, const IdentifierInput& given,
                        const MapModel& model) {
  // gravity and inertia, where they are asked for, and what a map needs
  const RigidPart rigid = PrepareRigid(given);
  MapBeginning begin;
  if (rigid.why) {
    begin.refusal = Refusal{rigid.status, *rigid.why};
    return begin;
  }
  begin = BeginMaps(rigid.Of(given), name, model.quantities, rigid);
  if (!begin.refusal) begin.task.candidates = model.maps(begin.points);
  return begin;
}

Fit FitMapModel(const std::string& name, const IdentifierInput& given, const MapModel& model) {
  const MapBeginning begin = BeginModel(name, given, model);
  if (begin.refusal) return Refused(name, *begin.refusal);
  const IdentifierInput input = begin.task.rigid.Of(given);
  if (model.heat == MapHeat::none) return FitCold(input, begin.task);

  // E, with these maps beside it
  Fit warm = FitWarm(input, begin.task);
  const bool warms = GivesFriction(warm);
  if (!model.over_energy || (!warms && model.heat == MapHeat::estimated)) return warm;
  // then maps over that E too
  Fit fit = IdentifyOverEnergy(input, begin.task, warms ? &warm : nullptr, model.over_energy);
  if (!warms && GivesFriction(fit)) {
    fit.causes.push_back(Remark(kWithoutWarming + Infer(warm).message, SentenceIn::message));
  }
  return fit;
}

}  // namespace warmjoint

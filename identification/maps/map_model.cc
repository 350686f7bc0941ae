#include "identification/maps/map_model.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/forward/log_trajectory.h"
#include "identification/inference/bounds.h"
#include "identification/inference/inference.h"
#include "identification/maps/warm_maps.h"
#include "identification/sentences/friction.h"
#include "identification/sentences/maps.h"
#include "identification/warming/fit_law.h"
#include "identification/warming/initial_energy.h"

namespace warmjoint {
namespace {

/// Law and maps without heat.
Fit FitCold(const IdentifierInput& input, const MapTask& task) {
  auto choice = ChooseAndFit(input, task);
  if (!choice) return Refused(task.identifier, Unsolvable());
  if (task.settings.bands == MapBands::none) return AsSketch(input, task, std::move(*choice));
  return AsFit(input, task, choice->fit, MapCovariance(choice->problem, choice->fit));
}

/// The fit that estimates E(0) from the log alone, where this contradicts the expected E(0);
/// else nothing.
std::optional<Fit> AgainstExpected(const IdentifierInput& input, const MapTask& task,
                                   const InitialEnergy& expected) {
  // law, maps and warming with an E(0) that is estimated from the log alone
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
  fit.causes.push_back(Note(unlike));
  return fit;
}

/// Law, maps and heat.
Fit FitWarm(const IdentifierInput& input, const MapTask& task) {
  // an expected start first, unless the log contradicts it
  const InitialEnergy initial = InitialEnergyOf(input.options);
  if (initial.is_expected()) {
    if (auto unlike = AgainstExpected(input, task, initial)) return *unlike;
  }
  const std::optional<WarmMaps> warm = FitWarmMaps(input, task, initial);
  return warm ? AsFit(input, *warm) : Refused(task.identifier, Unsolvable());
}

constexpr int kMostOverEnergy = 20;  // rounds
constexpr double kConverged = 1e-4;  // of E between rounds, relative to its range

double Range(const Eigen::VectorXd& x) { return x.maxCoeff() - x.minCoeff(); }

/// E that law, maps and warming predict together, [N] N.m or N.
Eigen::VectorXd EnergyOf(const MapTask& task, const MapFit& maps, const Fit& warm,
                         const LogSamples& measurements) {
  Friction friction = FrictionOf(*task.law, maps.law(), measurements);
  friction.thermal = warm.model.friction.thermal;
  friction.maps = maps.maps;
  return PredictFriction(friction, measurements, warm.Start()).energy;
}

/// The rows of the heat as the first fit estimates them, without intervals.
std::vector<Unknown> HeatOf(const Fit& warm, const LogSamples& m) {
  std::vector<Unknown> rows = HeatParameters(*warm.model.friction.thermal, m);
  std::ranges::copy_if(warm.parameters, std::back_inserter(rows), [](const Unknown& row) {
    return row.role == Role::start || row.role == Role::jump;
  });
  for (Unknown& row : rows) row.estimated = row.has_interval = false;
  return rows;
}

/// Adds the warming, which has no column of its own, and checks the friction against its own heat.
Fit Complete(const Fit& warm, int rounds, const LogSamples& m, Fit fit) {
  // gain, time constant and start of the warming stay as the fit without these maps has them
  fit.model.friction.thermal = warm.model.friction.thermal;
  fit.start.energy = warm.start.energy;
  fit.start.jump_samples = warm.start.jump_samples;
  if (!GivesFriction(fit)) return fit;
  const std::vector<Unknown> heat = HeatOf(warm, m);
  Append(heat, fit);
  // friction that drives the joint by its own heat is not a valid model
  const Prediction prediction = PredictFriction(fit.model.friction, m, fit.Start());
  if (prediction.first_driving < m.size()) {
    return Refused(fit.identifier, Status::inadequate_model,
                   ExplainDriving(m.time[prediction.first_driving], kFewerKernels));
  }

  // the torque is compared with the model with that heat
  fit.rows.fitted = Kept(prediction.force, fit.rows.used);
  fit.rows.count += static_cast<int>(heat.size());
  fit.rows.effective_parameters += static_cast<double>(heat.size());
  fit.causes.push_back(Note(ExplainMapsOverEnergy(rounds), SentenceIn::message));
  return fit;
}

/// Maps over the energy of a fit in place of its own. warm: null where nothing warms; task: its candidates and energy
/// are not read
Fit FitOverEnergy(const IdentifierInput& input, MapTask task, const Fit* warm,
                  const MapMaker& maker) {
  const LogSamples& m = input.measurements;
  // the energy that the fit without these maps predicts
  if (warm) task.energy = PredictFriction(warm->model.friction, m, warm->Start()).energy;
  task.candidates = maker(Kept(PointsOf(m, task.energy), input.selection));

  // until the fitted friction predicts the energy that it was fitted with
  std::optional<MapChoice> choice = ChooseAndFit(input, task);
  int rounds = 1;
  for (; choice && warm && rounds < kMostOverEnergy; ++rounds) {
    task = Settled(task, choice->fit);
    // the energy by the losses of law and maps together
    const Eigen::VectorXd energy = EnergyOf(task, choice->fit, *warm, m);
    if (!energy.allFinite()) return Refused(task.identifier, Unsolvable());
    // settled where the energy hardly changes, by its range
    const double change = (energy - task.energy).cwiseAbs().maxCoeff();
    if (change <= kConverged * Range(energy)) break;
    task.energy = energy;
    choice = ChooseAndFit(input, task);
  }
  if (!choice) return Refused(task.identifier, Unsolvable());
  // the fit with its errors, given that energy
  Fit fit = AsFit(input, task, choice->fit, MapCovariance(choice->problem, choice->fit));
  return warm ? Complete(*warm, rounds, m, std::move(fit)) : fit;
}

/// Maps over the energy of a law without maps.
Fit FitBehindLaw(const std::string& name, const IdentifierInput& input, const MapModel& model) {
  Fit warm = FitLaw(name, input, PartFit::estimated);
  if (!GivesFriction(warm)) return warm;
  const MapTask task = MakeMapTask(input, name);
  std::optional<Thermal>& thermal = warm.model.friction.thermal;
  if (model.heat_of_all) thermal = model.heat_of_all(input, *task.law, *thermal);
  return FitOverEnergy(input, task, &warm, model.over_energy);
}

}  // namespace

MapBeginning BeginModel(const std::string& name, const IdentifierInput& given,
                        const MapModel& model) {
  MapBeginning begin = BeginMaps(given, name, model.quantities);
  if (!begin.refusal) begin.task.candidates = model.maps(begin.points);
  return begin;
}

Fit FitMapModel(const std::string& name, const IdentifierInput& given, const MapModel& model) {
  if (model.heat == MapHeat::of_law) return FitBehindLaw(name, given, model);
  const MapBeginning begin = BeginModel(name, given, model);
  if (begin.refusal) return Refused(name, *begin.refusal);
  const IdentifierInput input = begin.task.rigid.Of(given);
  if (model.heat == MapHeat::none) return FitCold(input, begin.task);

  // E, with these maps
  Fit warm = FitWarm(input, begin.task);
  const bool warms = GivesFriction(warm);
  if (!model.over_energy || (!warms && model.heat == MapHeat::estimated)) return warm;
  // then maps over that E too
  Fit fit = FitOverEnergy(input, begin.task, warms ? &warm : nullptr, model.over_energy);
  if (!warms && GivesFriction(fit)) {
    fit.causes.push_back(Note(ExplainWithoutWarming(Infer(warm).message), SentenceIn::message));
  }
  return fit;
}

}  // namespace warmjoint

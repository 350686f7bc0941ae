#include "identification/maps/over_energy.h"

#include <fmt/format.h>

#include "identification/fit_data.h"
#include "identification/forward/predict.h"

namespace warmjoint::inline identification {
namespace {

constexpr int kMostRounds = 20;
constexpr double kAtRest = 1e-4;  // of E between rounds, relative to its range

FrictionDescription Describe(const MapTask& task, const MapFit& fit, const KnownEnergy& known,
                             double gear) {
  FrictionDescription friction;
  friction.law = task.settings.law;
  const Law& law = *FindLaw(friction.law);
  for (size_t i = 0; i < law.parameters.size(); ++i) {
    friction.parameters[std::string(law.parameters[i].name)] = fit.x[static_cast<Eigen::Index>(i)];
  }
  if (known.friction) friction.thermal = known.friction->thermal;
  friction.gear = gear;
  friction.maps = fit.maps;
  return friction;
}

double Range(const Eigen::VectorXd& x) { return x.maxCoeff() - x.minCoeff(); }

/// Adds the thermal part, and checks the friction against its own heat.
Estimate Complete(const IdentifierInput& input, const KnownEnergy& known, int rounds,
                  Estimate estimate) {
  if (!estimate.friction || !known.friction) return estimate;
  const Measurements& m = input.measurements;
  estimate.friction->thermal = known.friction->thermal;
  for (EstimatedParameter parameter : known.thermal) {
    parameter.std = {}, parameter.interval95 = {};
    estimate.parameters.push_back(std::move(parameter));
  }
  Metrics& metrics = *estimate.metrics;
  const Eigen::VectorXd torque = Kept(m.torque, input.selection);
  const Prediction prediction = PredictFriction(*estimate.friction, m);
  metrics = ComputeMetrics(torque, Kept(prediction.force, input.selection), metrics.parameters + 2,
                           metrics.effective_parameters + 2);
  if (prediction.feeds_itself < m.size()) {
    return Failed(
        estimate.identifier, Status::inadequate_model,
        WouldFeedItself(m.time[prediction.feeds_itself], "use fewer kernels, or another law"));
  }
  estimate.message += fmt::format(
      "; its own heat agrees with E after {} rounds; gain and time constant have no interval: maps "
      "over the energy take part in what they do",
      rounds);
  return estimate;
}

}  // namespace

KnownEnergy EnergyOf(const Estimate& estimate) {
  KnownEnergy known;
  if (estimate.status != Status::ok || !estimate.friction) return known;
  known.friction = estimate.friction;
  for (const EstimatedParameter& parameter : estimate.parameters) {
    if (parameter.name.starts_with("thermal_")) known.thermal.push_back(parameter);
  }
  return known;
}

Estimate IdentifyOverEnergy(const IdentifierInput& input, MapTask task, const KnownEnergy& known,
                            const MapMaker& maker) {
  const Measurements& m = input.measurements;
  if (known.friction) task.energy = PredictFriction(*known.friction, m).energy;
  task.candidates = maker(Kept(PointsOf(m, task.energy), input.selection));

  std::optional<MapChoice> choice = ChooseAndFit(input, task);
  int rounds = 1;
  for (; choice && known.friction && rounds < kMostRounds; ++rounds) {
    task = Settled(task, choice->fit);
    const FrictionDescription friction = Describe(task, choice->fit, known, m.gear);
    const Eigen::VectorXd energy = PredictFriction(friction, m).energy;
    if (!energy.allFinite()) return Unsolvable(task.identifier);
    const double change = (energy - task.energy).cwiseAbs().maxCoeff();
    if (change <= kAtRest * Range(energy)) break;
    task.energy = energy;
    choice = ChooseAndFit(input, task);
  }
  if (!choice) return Unsolvable(task.identifier);
  const Uncertainty uncertainty = JudgeMaps(choice->problem, choice->fit);
  return Complete(input, known, rounds, ReportMaps(input, task, choice->fit, uncertainty));
}

}  // namespace warmjoint::inline identification

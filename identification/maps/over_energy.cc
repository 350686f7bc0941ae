#include "identification/maps/over_energy.h"

#include <algorithm>
#include <iterator>

#include "identification/explain.h"
#include "identification/fit_data.h"
#include "identification/fit_parameters.h"
#include "identification/forward/log_course.h"
#include "identification/physical_bounds.h"

namespace warmjoint {
namespace {

constexpr int kMostRounds = 20;
constexpr double kConverged = 1e-4;  // of E between rounds, relative to its range

double Range(const Eigen::VectorXd& x) { return x.maxCoeff() - x.minCoeff(); }

/// E that law, maps and warming predict together, [N] N.m or N.
Eigen::VectorXd EnergyOf(const MapTask& task, const MapFit& maps, const Fit& warm,
                         const LogSamples& measurements) {
  Friction friction = FrictionOf(*task.law, maps.law(), measurements);
  friction.thermal = warm.friction.thermal;
  friction.maps = maps.maps;
  return PredictFriction(friction, measurements, warm.Start()).energy;
}

/// Rows of what the first fit tells of the heat, without intervals.
std::vector<FitParameter> HeatOf(const Fit& warm, const LogSamples& m) {
  std::vector<FitParameter> rows = HeatParameters(*warm.friction.thermal, m);
  std::ranges::copy_if(warm.parameters, std::back_inserter(rows), [](const FitParameter& row) {
    return row.role == Role::start || row.role == Role::jump;
  });
  for (FitParameter& row : rows) row.estimated = row.has_interval = false;
  return rows;
}

/// Adds the warming, which has no column of its own, and checks the friction against its own heat.
Fit Complete(const Fit& warm, int rounds, const LogSamples& m, Fit fit) {
  // gain, time constant and start of the warming stay as the fit without these maps has them
  fit.friction.thermal = warm.friction.thermal;
  fit.initial_energy = warm.initial_energy;
  fit.jump_samples = warm.jump_samples;
  if (!GivesFriction(fit)) return fit;
  const std::vector<FitParameter> heat = HeatOf(warm, m);
  Append(heat, fit);
  // friction that drives itself by its own heat is no model
  const Prediction prediction = PredictFriction(fit.friction, m, fit.Start());
  if (prediction.feeds_itself < m.size()) {
    return Refused(
        fit.identifier, Status::inadequate_model,
        ExplainFeedingItself(m.time[prediction.feeds_itself], "use fewer kernels, or another law"));
  }

  // what the torque is compared with follows from that heat
  fit.fitted = Kept(prediction.force, fit.used);
  fit.count += static_cast<int>(heat.size());
  fit.effective_parameters += static_cast<double>(heat.size());
  fit.causes.push_back(Remark(ExplainMapsOverEnergy(rounds), SentenceIn::message));
  return fit;
}

}  // namespace

Fit IdentifyOverEnergy(const IdentifierInput& input, MapTask task, const Fit* warm,
                       const MapMaker& maker) {
  const LogSamples& m = input.measurements;
  // the energy that the fit without these maps predicts
  if (warm) task.energy = PredictFriction(warm->friction, m, warm->Start()).energy;
  task.candidates = maker(Kept(PointsOf(m, task.energy), input.selection));

  // until the fitted friction predicts the energy that it was fitted with
  std::optional<MapChoice> choice = ChooseAndFit(input, task);
  int rounds = 1;
  for (; choice && warm && rounds < kMostRounds; ++rounds) {
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
  // the fit with its errors, given that course of the energy
  Fit fit = AsFit(input, task, choice->fit, MapCovariance(choice->problem, choice->fit));
  return warm ? Complete(*warm, rounds, m, std::move(fit)) : fit;
}

}  // namespace warmjoint

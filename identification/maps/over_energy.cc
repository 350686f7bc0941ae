#include "identification/maps/over_energy.h"

#include <fmt/format.h>

#include "identification/fit_data.h"
#include "identification/fit_parameters.h"
#include "identification/inference/bounds.h"
#include "models/recording/course_of.h"

namespace warmjoint::inline identification {
namespace {

constexpr int kMostRounds = 20;
constexpr double kAtRest = 1e-4;  // of E between rounds, relative to its range

double Range(const Eigen::VectorXd& x) { return x.maxCoeff() - x.minCoeff(); }

/// E that law, maps and warming predict together, [N] N.m or N.
Eigen::VectorXd EnergyOf(const MapTask& task, const MapFit& maps, const Thermal& thermal,
                         const Measurements& measurements) {
  FrictionDescription friction =
      FrictionOf(*FindLaw(task.settings.law), maps.x.head(maps.free), measurements);
  friction.thermal = thermal;
  friction.maps = maps.maps;
  return PredictFriction(friction, measurements).energy;
}

/// Adds the warming, which has no column of its own, and checks the friction against its own heat.
Fit Complete(const Thermal& thermal, int rounds, const Measurements& m, Fit fit) {
  fit.friction.thermal = thermal;
  if (!GivesFriction(fit)) return fit;
  std::vector<FitParameter> heat = HeatParameters(thermal, m);
  for (FitParameter& row : heat) row.estimated = row.has_interval = false;
  Append(heat, fit);
  const Prediction prediction = PredictFriction(fit.friction, m);
  if (prediction.feeds_itself < m.size()) {
    return Refused(
        fit.identifier, Status::inadequate_model,
        WouldFeedItself(m.time[prediction.feeds_itself], "use fewer kernels, or another law"));
  }

  // what the torque is compared with follows from that heat
  fit.fitted = Kept(prediction.force, fit.used);
  fit.count += 2;
  fit.effective_parameters += 2;
  fit.afterword += fmt::format(
      "; the energy state is consistent with the losses of the fit after {} rounds; thermal_gain "
      "and thermal_time_constant have no interval, since maps over the energy absorb part of their "
      "effect",
      rounds);
  return fit;
}

}  // namespace

Fit IdentifyOverEnergy(const IdentifierInput& input, MapTask task,
                       const std::optional<FrictionDescription>& warm, const MapMaker& maker) {
  const Measurements& m = input.measurements;
  if (warm) task.energy = PredictFriction(*warm, m).energy;
  task.candidates = maker(Kept(PointsOf(m, task.energy), input.selection));

  // until the fitted friction predicts the energy that it was fitted with
  std::optional<MapChoice> choice = ChooseAndFit(input, task);
  int rounds = 1;
  for (; choice && warm && rounds < kMostRounds; ++rounds) {
    task = Settled(task, choice->fit);
    const Eigen::VectorXd energy = EnergyOf(task, choice->fit, *warm->thermal, m);
    if (!energy.allFinite()) return Refused(task.identifier, Unsolvable());
    const double change = (energy - task.energy).cwiseAbs().maxCoeff();
    if (change <= kAtRest * Range(energy)) break;
    task.energy = energy;
    choice = ChooseAndFit(input, task);
  }
  if (!choice) return Refused(task.identifier, Unsolvable());
  Fit fit = AsFit(input, task, choice->fit, JudgeMaps(choice->problem, choice->fit));
  return warm ? Complete(*warm->thermal, rounds, m, std::move(fit)) : fit;
}

}  // namespace warmjoint::inline identification

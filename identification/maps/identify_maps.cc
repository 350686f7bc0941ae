#include "identification/maps/identify_maps.h"

#include <warmjoint/estimate.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/gravity.h"
#include "identification/inference/bounds.h"
#include "identification/linear/linear_laws.h"
#include "identification/maps/energy_ml_maps.h"
#include "identification/maps/holes.h"
#include "identification/maps/make_bands.h"
#include "identification/model/least_squares.h"
#include "identification/sentences/maps.h"
#include "identification/uncertainty/tails.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

constexpr double kBeyondDoubt =
    3.5;  // standard errors; why: by chance once in a thousand logs, of two values

/// Why the kept samples, [n x 5] `points`, do not determine a map over a quantity.
std::optional<std::string> Unseen(MapQuantity quantity, const LogSamples& measurements,
                                  const MapPoints& points) {
  if (quantity == MapQuantity::load && !measurements.load) {
    return kMapOverUnknownLoad;
  }
  const bool is_unknown =
      quantity == MapQuantity::position ||
      (quantity == MapQuantity::motor_position && !KnowsMotorAngle(measurements));
  if (measurements.position_integrated && is_unknown) {
    return ExplainMapWithoutPositions(quantity);
  }
  return CannotCarry(quantity, points);
}

/// The table's rows of the law, without intervals and with a warning where kernels can imitate it.
void AddLaw(const Law& law, const MapFit& maps, const LogSamples& measurements, Fit& fit) {
  const Eigen::VectorXd values = maps.law();
  fit.parameters = WithValues(LawUnknowns(law, values.size(), UnitsOf(measurements)), values);
  std::vector<std::string> imitated;
  // a column that kernels can imitate has no interval of its own
  for (const Eigen::Index i : ImitatedColumns(maps.gram, maps.free())) {
    if (i >= static_cast<Eigen::Index>(law.parameters.size())) continue;
    Unknown& parameter = fit.parameters[static_cast<size_t>(i)];
    parameter.has_interval = false;
    imitated.push_back(parameter.name);
  }
  for (const Unknown& row : fit.parameters) {
    const bool held = row.has_interval && row.value == row.lower;
    if (held) fit.causes.push_back(Note(ExplainHeldBesideMaps(row)));
  }
  if (!imitated.empty()) fit.causes.push_back(Note(ExplainImitated(imitated)));
}

/// The samples that law and maps are fitted to; without maps.
MapProblem ProblemOf(const IdentifierInput& input, const MapTask& task) {
  // columns of the law, and next to them those of gravity and inertia
  const Law& law = *task.law;
  const Eigen::MatrixXd columns =
      ConcatColumns(LawColumns(law, input.measurements.velocity), task.rigid.columns);
  MapProblem problem{{},
                     Kept(PointsOf(input.measurements, task.energy), input.selection),
                     Kept(columns, input.selection),
                     Kept(input.measurements.torque, input.selection),
                     input.selection};
  problem.torque -= TorqueOfEnergy(input, task.energy);
  // bounds of the law's parameters; gravity and inertia have none
  for (const ParameterInfo& info : law.parameters) problem.lower.push_back(info.lower);
  problem.lower.resize(static_cast<size_t>(columns.cols()), -kInfinity);
  problem.of_law = std::ssize(law.parameters);
  return problem;
}

/// Bands of a fit of law and maps, and friction at speeds.
void AddBands(const IdentifierInput& input, const MapTask& task, const MapFit& maps,
              const Uncertainty& uncertainty, Fit& fit) {
  const Law& law = *task.law;
  const MapProblem problem = ProblemOf(input, task);
  MakeBands(law, problem, maps, uncertainty, fit);
  WidenUnresolved(maps.maps.front(), input.measurements,
                  StudentQuantile(uncertainty.degrees_of_freedom, kIntervalLevel),
                  fit.figures.bands.front());
  fit.figures.friction_at_speeds = FrictionAtSpeeds(law, maps, uncertainty, problem.points);
  // friction that is below 0 beyond doubt, in the mean over its places
  const auto drives =
      std::ranges::find_if(fit.figures.friction_at_speeds,
                           [](const FrictionAtSpeed& one) { return one.interval95[1] < 0; });
  if (drives != fit.figures.friction_at_speeds.end()) {
    fit.causes.push_back(Invalidate(Status::inadequate_model,
                                    ExplainDrivingFriction(*drives, input.measurements, fit)));
  }
}

}  // namespace

MapTask MakeMapTask(const IdentifierInput& input, const std::string& identifier) {
  MapTask task{.identifier = identifier,
               .law = input.options.Get<LawOption>().law,
               .settings = input.options.Get<MapOptions>()};
  task.rigid.columns.resize(input.measurements.size(), 0);
  return task;
}

MapBeginning BeginMaps(const IdentifierInput& given, const std::string& identifier,
                       const std::vector<MapQuantity>& quantities) {
  MapBeginning begin{MakeMapTask(given, identifier), {}, {}};
  // law, gravity and inertia must be distinct before maps are fitted
  LinearTask linear = BeginLinear(given, 2);
  begin.task.rigid = linear.gravity;
  const IdentifierInput input = begin.task.rigid.Of(given);
  SolveLinear(input, linear);
  begin.refusal = linear.refusal;
  if (begin.refusal) return begin;
  // each quantity of the maps must be known and must vary
  begin.points = Kept(PointsOf(input.measurements), input.selection);
  for (const MapQuantity quantity : quantities) {
    const auto why = Unseen(quantity, input.measurements, begin.points);
    if (!why) continue;
    begin.refusal = Refusal{Status::bad_data, *why};
    break;
  }
  return begin;
}

Eigen::VectorXd TorqueOfEnergy(const IdentifierInput& input, const Eigen::VectorXd& energy) {
  const LogSamples& m = input.measurements;
  if (energy.size() == 0) return Eigen::VectorXd::Zero(input.selection.count());
  const Eigen::VectorXd direction = m.velocity.array().sign();
  return Kept(direction.cwiseProduct(energy), input.selection);
}

Refusal Unsolvable() { return {Status::bad_data, kUnsolvableMaps}; }

std::optional<ChosenProblem> Choose(const IdentifierInput& input, const MapTask& task) {
  MapProblem problem = ProblemOf(input, task);
  problem.rows = task.rows;

  // a choice takes many fits, so it is made only where there is more than one possibility
  ChosenMaps best{0, task.settings.strength, 0, {}};
  if (task.candidates.size() > 1 || task.settings.strength == 0) {
    const int folds = task.folds(problem.torque.size());
    best = ChooseMaps(problem, task.candidates, task.settings.selection, folds);
    if (!std::isfinite(best.criterion)) return std::nullopt;
    if (task.settings.strength > 0) best.strength = task.settings.strength;
  }
  // shape and strength that predict best, with the products of their fit
  problem.maps = task.candidates[best.candidate];
  if (!best.normal) best.normal = NormalOf(problem);
  return ChosenProblem{std::move(problem), std::move(*best.normal), best.strength};
}

std::optional<MapChoice> ChooseAndFit(const IdentifierInput& input, const MapTask& task) {
  std::optional<ChosenProblem> chosen = Choose(input, task);
  if (!chosen) return std::nullopt;
  std::optional<MapFit> fit = FitMaps(chosen->problem, std::move(chosen->normal), chosen->strength);
  if (!fit) return std::nullopt;
  return MapChoice{std::move(chosen->problem), std::move(*fit)};
}

MapTask Settled(MapTask task, const MapWeights& fit) {
  task.candidates = {fit.maps};
  task.settings.strength = fit.strength;
  return task;
}

namespace {

/// The task with gravity, and with a constant that a level for each direction would explain as well.
MapTask WithGravity(const MapTask& task, const MapWeights& fit, const Eigen::VectorXd& position) {
  MapTask with = Settled(task, fit);
  // maps that no longer have to follow gravity have weights of another size
  with.settings.strength = 0;
  Eigen::MatrixXd columns = GravityColumns(GravityKind::sincos, {}, position);
  with.rigid.columns = ConcatColumns(ConcatColumns(columns, Eigen::VectorXd::Ones(position.size())),
                                     task.rigid.columns);
  return with;
}

/// Whether maps over the angle of a joint have taken up gravity: what they hold of g1 sin p + g2 cos p is relevant
/// relative to the friction of the law, and a fit that has both distinguishes that gravity from them beyond doubt.
bool HoldsGravity(const IdentifierInput& input, const MapTask& task, const MapFit& maps) {
  const LogSamples& m = input.measurements;
  const bool asks = m.joint == JointKind::rotary && task.rigid.gravity_count() == 0 &&
                    m.position.allFinite() && input.selection.count() > 2 * maps.free() + 6;
  if (!asks) return false;

  // what the maps hold of it, in addition to law and constant
  const MapTask with = WithGravity(task, maps, m.position);
  const Eigen::MatrixXd gravity = Kept(with.rigid.columns.leftCols(3), input.selection);
  const Law& law = *task.law;
  const Eigen::MatrixXd columns = Kept(LawColumns(law, m.velocity), input.selection);
  const Eigen::VectorXd of_law = columns * maps.law();
  const Eigen::VectorXd of_maps =
      EvaluateMaps(maps.maps, Kept(PointsOf(m, task.energy), input.selection));
  const LeastSquares held = SolveLeastSquares(ConcatColumns(gravity, columns), of_maps);
  if (!held.mixed.empty()) return false;
  const double size = (gravity.leftCols(2) * held.solution.head(2)).norm();
  if (size < kDefaultRelevance * of_law.norm()) return false;

  // and whether a fit with both needs that gravity
  const std::optional<MapChoice> choice = ChooseAndFit(input, with);
  if (!choice) return false;
  const Uncertainty uncertainty = MapCovariance(choice->problem, choice->fit);
  const Eigen::Index first = choice->fit.of_rigid.begin;
  return std::abs(choice->fit.x[first]) > kBeyondDoubt * uncertainty.Deviation(first) ||
         std::abs(choice->fit.x[first + 1]) > kBeyondDoubt * uncertainty.Deviation(first + 1);
}

/// All but errors and bands.
Fit ModelOf(const IdentifierInput& input, const MapTask& task, const MapFit& maps) {
  const LogSamples& m = input.measurements;
  const Law& law = *task.law;

  // the law, and the maps next to it
  Fit fit;
  fit.identifier = task.identifier;
  fit.model.friction = FrictionOf(law, maps.law(), m);
  fit.model.friction.maps = maps.maps;
  AddLaw(law, maps, m, fit);
  AddRigid(task.rigid, maps.rigid(), m, fit);

  // how well they fit
  fit.rows.used = input.selection;
  fit.rows.torque = Kept(m.torque, fit.rows.used);
  fit.rows.fitted = maps.fitted + TorqueOfEnergy(input, task.energy);
  fit.rows.count = static_cast<int>(maps.x.size());
  fit.rows.effective_parameters = maps.effective;
  fit.summary = SummaryOfMaps({.law = law.name,
                               .maps = maps.maps,
                               .samples = fit.rows.torque.size(),
                               .strength = maps.strength,
                               .effective = maps.effective});
  if (HoldsGravity(input, task, maps)) {
    fit.causes.push_back(Invalidate(Status::inadequate_model, kMapHoldsGravity));
  }
  // places without data
  const std::vector<std::string> holes = NameHoles(maps.maps, maps.unseen, m.joint);
  if (!holes.empty()) fit.causes.push_back(Note(ExplainHoles(holes)));
  return fit;
}

/// The uncertainty of the law and of the other parameters of the table, without the weights.
Uncertainty OfTable(Uncertainty uncertainty, const MapFit& maps) {
  uncertainty.covariance = uncertainty.covariance.topLeftCorner(maps.free(), maps.free()).eval();
  return uncertainty;
}

}  // namespace

Fit AsFit(const IdentifierInput& input, const MapTask& task, const MapFit& maps,
          const Uncertainty& uncertainty) {
  if (!uncertainty.covariance.allFinite()) return Refused(task.identifier, Unsolvable());
  Fit fit = ModelOf(input, task, maps);
  fit.rows.errors.covariance = [of_table = OfTable(uncertainty, maps)] { return of_table; };
  if (task.settings.bands == MapBands::none || !GivesFriction(fit)) return fit;
  AddBands(input, task, maps, uncertainty, fit);
  // what a motor's map shows, which comes first
  const FrictionMap& first = maps.maps.front();
  if (first.axes.front().quantity != MapQuantity::motor_position) return fit;
  const auto count = static_cast<Eigen::Index>(first.size());
  DescribeMotorRipple(first, uncertainty.covariance.block(maps.free(), maps.free(), count, count),
                      input.measurements, fit);
  return fit;
}

Fit AsSketch(const IdentifierInput& input, const MapTask& task, MapChoice choice) {
  if (!choice.fit.inverse.allFinite()) return Refused(task.identifier, Unsolvable());
  Fit fit = ModelOf(input, task, choice.fit);
  fit.rows.errors.covariance = [kept = std::make_shared<const MapChoice>(std::move(choice))] {
    return OfTable(MapCovariance(kept->problem, kept->fit), kept->fit);
  };
  return fit;
}

}  // namespace warmjoint

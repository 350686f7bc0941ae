#include "identification/maps/identify_maps.h"

#include <fmt/format.h>

#include <cmath>

#include "identification/describe_friction.h"
#include "identification/fit_data.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/report_law.h"
#include "identification/maps/make_bands.h"
#include "models/friction/sign.h"

namespace warmjoint::inline identification {
namespace {

/// Why the law alone cannot be fitted, or the data not used, as an estimate that failed; nothing
/// where all is well.
std::optional<Estimate> RefuseForMaps(const IdentifierInput& input, const std::string& identifier,
                                      const Law& law) {
  const auto d = static_cast<int>(law.parameters.size());
  if (auto why = Unusable(input, d + 2)) return Failed(identifier, Status::bad_data, *why);
  const Eigen::MatrixXd A =
      LawColumns(law, Kept(input.measurements.velocity, input.selection).col(0));
  const LeastSquares fit = SolveLeastSquares(A, Kept(input.measurements.torque, input.selection));
  if (fit.mixed.empty()) return std::nullopt;
  return Failed(identifier, Status::not_identifiable,
                Indistinct(fit.mixed, law, input.measurements, input.selection));
}

/// Why no map over a quantity can be told from the kept samples, [n x 5] `points`.
std::optional<std::string> Unseen(MapQuantity quantity, const Measurements& measurements,
                                  const MapPoints& points) {
  if (quantity == MapQuantity::load && !measurements.load) {
    return "the recording has no column load; log the load that the joint transmits, or use "
           "energy-map";
  }
  return CannotCarry(quantity, points);
}

}  // namespace

MapBeginning BeginMaps(const IdentifierInput& input, const std::string& identifier,
                       std::initializer_list<MapQuantity> quantities) {
  MapBeginning begin{{identifier, ReadMapSettings(input.options), {}, {}}, {}, {}};
  begin.refusal = RefuseForMaps(input, identifier, *FindLaw(begin.task.settings.law));
  if (begin.refusal) return begin;
  begin.points = Kept(PointsOf(input.measurements), input.selection);
  for (const MapQuantity quantity : quantities) {
    const auto why = Unseen(quantity, input.measurements, begin.points);
    if (!why) continue;
    begin.refusal = Failed(identifier, Status::bad_data, *why);
    break;
  }
  return begin;
}

Eigen::VectorXd TakenByEnergy(const IdentifierInput& input, const Eigen::VectorXd& energy) {
  const Measurements& m = input.measurements;
  if (energy.size() == 0) return Eigen::VectorXd::Zero(input.selection.count());
  const Eigen::VectorXd direction =
      m.velocity.unaryExpr([](double v) { return static_cast<double>(Sign(v)); });
  return Kept(direction.cwiseProduct(energy), input.selection);
}

std::string DescribeMapFit(const IdentifierInput& input, const MapTask& task, const MapFit& fit,
                           const NoiseModel& noise) {
  return fmt::format(
      "law {} and {} on {} samples; prior of strength {:.3g} on their weights leaves {:.1f} "
      "effective parameters{}",
      task.settings.law, ShapeOf(fit.maps), input.selection.count(), fit.strength, fit.effective,
      ColourOf(noise));
}

std::string ShapeOf(const std::vector<FrictionMap>& maps) {
  std::vector<std::string> shapes;
  for (const FrictionMap& map : maps) {
    std::vector<std::string> axes;
    for (const MapAxis& axis : map.axes) {
      axes.push_back(fmt::format("{} {}", axis.kernels.size(), MapQuantityName(axis.quantity)));
    }
    shapes.push_back(fmt::format("{} kernels", fmt::join(axes, " x ")));
  }
  return fmt::format("{}", fmt::join(shapes, " and "));
}

void ReportLawBesideMaps(const Law& law, const MapFit& fit, const Uncertainty& known,
                         const Measurements& measurements, Estimate& estimate) {
  const size_t first = estimate.parameters.size();
  ReportLaw(law, fit.x.head(fit.free), known, measurements, estimate);
  std::vector<std::string> imitated;
  for (const Eigen::Index i : ImitatedColumns(fit)) {
    EstimatedParameter& parameter = estimate.parameters[first + static_cast<size_t>(i)];
    parameter.std.reset();
    parameter.interval95.reset();
    imitated.push_back(parameter.name);
  }
  if (imitated.empty()) return;
  estimate.warnings.push_back(fmt::format(
      "the kernels can imitate {}, which the prior alone tells apart", fmt::join(imitated, ", ")));
}

Estimate Unsolvable(const std::string& identifier) {
  return Failed(identifier, Status::bad_data,
                "the normal equations cannot be solved: torque or velocity are too large or too "
                "small to square; check their units");
}

std::optional<MapChoice> ChooseAndFit(const IdentifierInput& input, const MapTask& task) {
  const Eigen::MatrixXd columns =
      LawColumns(*FindLaw(task.settings.law), input.measurements.velocity);
  const MapPoints all = PointsOf(input.measurements, task.energy);
  MapProblem problem{{},
                     Kept(all, input.selection),
                     Kept(columns, input.selection),
                     Kept(input.measurements.torque, input.selection),
                     input.selection};
  problem.torque -= TakenByEnergy(input, task.energy);

  for (const ParameterInfo& info : FindLaw(task.settings.law)->parameters) {
    problem.lower.push_back(info.lower);
  }

  // a choice costs fits, so one is made only where there is something to choose
  ChosenMaps best{0, task.settings.strength, 0};
  if (task.candidates.size() > 1 || task.settings.strength == 0) {
    const int folds =
        std::min(task.settings.folds, std::max(2, static_cast<int>(problem.torque.size()) / 2));
    best = ChooseMaps(problem, task.candidates, task.settings.rule, folds);
    if (!std::isfinite(best.criterion)) return std::nullopt;
    if (task.settings.strength > 0) best.strength = task.settings.strength;
  }
  problem.maps = task.candidates[best.candidate];
  std::optional<MapFit> fit = FitMaps(problem, best.strength);
  if (!fit) return std::nullopt;
  return MapChoice{std::move(problem), std::move(*fit)};
}

MapTask Settled(MapTask task, const MapFit& fit) {
  task.candidates = {fit.maps};
  task.settings.strength = fit.strength;
  return task;
}

Estimate ReportMaps(const IdentifierInput& input, const MapTask& task, const MapFit& fit,
                    const Uncertainty& known) {
  if (!known.covariance.allFinite()) return Unsolvable(task.identifier);
  const Measurements& m = input.measurements;
  const Law& law = *FindLaw(task.settings.law);
  Estimate estimate;
  estimate.identifier = task.identifier;
  ReportLawBesideMaps(law, fit, known, m, estimate);
  estimate.metrics = ComputeMetrics(Kept(m.torque, input.selection),
                                    fit.fitted + TakenByEnergy(input, task.energy),
                                    static_cast<int>(fit.x.size()), fit.effective);
  estimate.message = DescribeMapFit(input, task, fit, known.noise);
  DescribeFriction(law, m, estimate);
  if (!estimate.friction) return estimate;
  estimate.friction->maps = fit.maps;
  estimate.bands = MakeBands(law, fit, known, Kept(PointsOf(m, task.energy), input.selection));
  return estimate;
}

Estimate IdentifyMaps(const IdentifierInput& input, const MapTask& task) {
  const auto choice = ChooseAndFit(input, task);
  if (!choice) return Unsolvable(task.identifier);
  return ReportMaps(input, task, choice->fit, JudgeMaps(choice->problem, choice->fit));
}

}  // namespace warmjoint::inline identification

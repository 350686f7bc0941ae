#include "identification/identify_maps.h"

#include <fmt/format.h>

#include <cmath>

#include "identification/fit_data.h"
#include "identification/least_squares.h"
#include "identification/linear_laws.h"
#include "identification/report_law.h"
#include "identification/student.h"
#include "models/friction/sign.h"

namespace warmjoint {
Eigen::VectorXd TakenByEnergy(const IdentifierInput& input, const Eigen::VectorXd& energy) {
  const Measurements& m = input.measurements;
  if (energy.size() == 0) return Eigen::VectorXd::Zero(input.selection.count());
  const Eigen::VectorXd direction =
      m.velocity.unaryExpr([](double v) { return static_cast<double>(Sign(v)); });
  return Kept(direction.cwiseProduct(energy), input.selection);
}

std::string DescribeMapFit(const IdentifierInput& input, const MapTask& task, const MapFit& fit,
                           const NoiseModel& noise) {
  const Law& law = *FindLaw(task.settings.law);
  std::vector<std::string> soft;
  for (const Eigen::Index i : ImitatedColumns(fit)) soft.emplace_back(law.parameters[i].name);
  std::string message = fmt::format(
      "law {} and {} on {} samples; prior of strength {:.3g} on their weights leaves {:.1f} "
      "effective parameters",
      law.name, ShapeOf(fit.maps), input.selection.count(), fit.strength, fit.effective);
  if (!soft.empty()) {
    message += fmt::format("; the kernels can imitate {}, which the prior alone tells apart",
                           fmt::join(soft, ", "));
  }
  return message + ColourOf(noise);
}

MapBand BandOf(const FrictionMap& map, const Eigen::MatrixXd& covariance, double freedom) {
  // centres of all axes, the last the fastest
  const auto count = static_cast<Eigen::Index>(map.size());
  MapBand band;
  MapPoints points = MapPoints::Zero(count, 5);
  points.col(static_cast<int>(MapQuantity::velocity)).setOnes();
  for (Eigen::Index i = 0; i < count; ++i) {
    std::vector<double> centre(map.axes.size());
    auto rest = static_cast<size_t>(i);
    for (size_t a = map.axes.size(); a-- > 0;) {
      const std::vector<double>& centres = map.axes[a].kernels.centres;
      centre[a] = centres[rest % centres.size()];
      points(i, static_cast<int>(map.axes[a].quantity)) = centre[a];
      rest /= centres.size();
    }
    band.points.push_back(std::move(centre));
  }
  for (const MapAxis& axis : map.axes) band.quantities.emplace_back(MapQuantityName(axis.quantity));

  band.value.resize(map.size());
  band.std.resize(map.size());
  band.interval95.resize(map.size());
  const double reach = StudentQuantile(freedom);
  for (const RowGroup& group : GroupRows({map}, points, 0, count)) {
    const Eigen::MatrixXd own = covariance(group.kernels, group.kernels);
    for (Eigen::Index i = 0; i < group.values.rows(); ++i) {
      const auto place = static_cast<size_t>(group.samples[i]);
      const Eigen::RowVectorXd row = group.values.row(i);
      const double deviation = std::sqrt(std::max(0.0, (row * own * row.transpose()).value()));
      const double value = EvaluateMap(map, PointAt(points, group.samples[i]));
      band.value[place] = value;
      band.std[place] = deviation;
      band.interval95[place] = {value - reach * deviation, value + reach * deviation};
    }
  }
  return band;
}

std::vector<MapBand> BandsOf(const std::vector<FrictionMap>& maps, const Uncertainty& known,
                             Eigen::Index first) {
  std::vector<MapBand> bands;
  for (const FrictionMap& map : maps) {
    const auto size = static_cast<Eigen::Index>(map.size());
    bands.push_back(BandOf(map, known.covariance.block(first, first, size, size), known.freedom));
    first += size;
  }
  return bands;
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

Estimate Unsolvable(const std::string& identifier) {
  return Failed(identifier, Status::bad_data,
                "the normal equations cannot be solved: torque or velocity are too large or too "
                "small to square; check their units");
}

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
  ReportLaw(law, fit.x.head(fit.free), known, m, estimate);
  estimate.metrics = ComputeMetrics(Kept(m.torque, input.selection),
                                    fit.fitted + TakenByEnergy(input, task.energy),
                                    static_cast<int>(fit.x.size()), fit.effective);
  estimate.message = DescribeMapFit(input, task, fit, known.noise);
  DescribeFriction(law, m, estimate);
  if (!estimate.friction) return estimate;
  estimate.friction->maps = fit.maps;
  estimate.bands = BandsOf(fit.maps, known, fit.free);
  return estimate;
}

Estimate IdentifyMaps(const IdentifierInput& input, const MapTask& task) {
  const auto choice = ChooseAndFit(input, task);
  if (!choice) return Unsolvable(task.identifier);
  return ReportMaps(input, task, choice->fit, JudgeMaps(choice->problem, choice->fit));
}

}  // namespace warmjoint

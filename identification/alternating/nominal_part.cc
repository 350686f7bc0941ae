#include "identification/alternating/nominal_part.h"

#include <warmjoint/prepared_log.h>

#include <utility>

#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

/// Law and kernels over position.
void AddMap(const IdentifierInput& input, const std::string& identifier, NominalPart& part) {
  // a map over position would take gravity up
  if (input.options.Get<GravityOption>().gravity != FittedGravity::none) {
    part.refusal = Refusal{Status::bad_data,
                           "position=map cannot be had together with gravity; leave one of them "
                           "out (basis=position takes gravity up into the map)"};
    return;
  }
  // law and map over moving samples, without any warming
  const IdentifierInput moving = input.With(part.moving);
  MapBeginning begin = BeginMaps(moving, identifier, {MapQuantity::position});
  part.refusal = begin.refusal;
  if (part.refusal) return;
  MapTask& task = begin.task;
  task.candidates = PositionMaps(input.options, begin.points);
  const auto choice = ChooseAndFit(moving, task);
  if (!choice) {
    part.refusal = Unsolvable();
    return;
  }
  // kernels join the law as further columns
  part.maps = choice->fit.maps;
  const MapPoints all = PointsOf(input.measurements);
  part.columns = ConcatColumns(part.columns, DenseKernels(part.maps, all, 0, all.rows()));
  part.cofactor = choice->fit.inverse;
  part.solution = choice->fit.x;
  part.strength = choice->fit.strength;
  part.effective = choice->fit.effective;
}

}  // namespace

Layout NominalPart::layout() const {
  Eigen::Index kernels = 0;
  for (const FrictionMap& map : maps) kernels += static_cast<Eigen::Index>(map.size());
  return Layout::InOrder({{&Layout::law, columns.cols() - gravity.count() - kernels},
                          {&Layout::rigid, gravity.count()},
                          {&Layout::weights, kernels},
                          {&Layout::heat, 2}});
}

std::vector<FrictionMap> NominalPart::MapsOf(const Eigen::VectorXd& nominal) const {
  return WithWeights(maps, layout().weights.Of(nominal));
}

NominalPart PrepareNominalPart(const IdentifierInput& given, const std::string& identifier) {
  // law and gravity, on enough samples for gain and time constant too
  LinearTask task = BeginLinear(given, 2);
  NominalPart part;
  part.gravity = task.gravity;
  part.refusal = task.refusal;
  if (part.refusal) return part;

  // samples that move
  const IdentifierInput input = part.gravity.Of(given);
  part.moving = WithoutRest(input.selection, input.measurements);
  part.columns = task.columns;
  if (given.options.Get<NominalMapOptions>().position == NominalMap::map) {
    AddMap(input, identifier, part);
    return part;
  }

  // the columns of Fn and G must be distinct before any warming is thought of
  LeastSquares fit = SolveLinear(input.With(part.moving), task);
  part.refusal = task.refusal;
  // the nominal fit, without warming
  part.cofactor = std::move(fit.cofactor);
  part.solution = std::move(fit.solution);
  part.effective = task.count();
  return part;
}

}  // namespace warmjoint

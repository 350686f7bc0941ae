#include "identification/alternating/nominal_part.h"

#include <warmjoint/prepared_log.h>

#include "identification/fit_data.h"
#include "identification/linear/linear_laws.h"
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
  const LogSamples& m = given.measurements;
  const Law& law = *given.options.Get<LawOption>().law;
  NominalPart part;
  // gravity, where it is asked for
  part.gravity = PrepareRigid(given);
  if (part.gravity.why) {
    part.refusal = Refusal{part.gravity.status, *part.gravity.why};
    return part;
  }
  const IdentifierInput input = part.gravity.Of(given);
  const auto d = static_cast<int>(law.parameters.size() + part.gravity.count());
  // enough samples for law, gravity, gain and time constant
  if (auto why = Unusable(input, d + 2)) {
    part.refusal = Refusal{Status::bad_data, *why};
    return part;
  }
  // samples that move
  part.moving = WithoutRest(input.selection, m);
  part.columns = LawColumns(law, m.velocity);
  if (given.options.Get<NominalMapOptions>().position == NominalMap::map) {
    AddMap(input, identifier, part);
    return part;
  }

  // the columns of Fn and G must be distinct before any warming is thought of
  part.columns = ConcatColumns(part.columns, part.gravity.columns);
  const LeastSquares fit =
      SolveLeastSquares(Kept(part.columns, part.moving), Kept(m.torque, part.moving));
  if (fit.rank < d) {
    part.refusal =
        Refusal{Status::not_identifiable, IndistinctColumns(fit.mixed, law, part.gravity, input)};
  }
  // the nominal fit, without warming
  part.cofactor = fit.cofactor;
  part.solution = fit.solution;
  part.effective = d;
  return part;
}

}  // namespace warmjoint

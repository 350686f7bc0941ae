#include "identification/nonlinear/falling_law.h"

#include <cassert>

#include "identification/fit/fit_parameters.h"

namespace warmjoint {
namespace {

template <typename L>
Eigen::VectorXd TableOf(const Eigen::VectorXd& x, double exponent) {
  const auto values = ValuesOf<L>(x.data(), exponent);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
}

/// p: {kv, kc, ks}, both directions alike.
template <typename L>
FallingLaw OfOneLevel() {
  return {*FindLaw(L::name),
          *FindLaw(ViscousCoulomb::name),
          Stribeck::name,
          FallingPlacesOf<L>(),
          &TableOf<L>,
          Eigen::Vector3d(0, -1, 1),
          "static less coulomb",
          [](const double* p) { return p[1]; },
          [](const double* p) { return p[2]; },
          [](double* p, double least, double most) {
            p[2] = std::clamp(p[2], least * p[1], most * p[1]);
          }};
}

/// p: {kv, kc+, kc-, kr}
template <typename L>
FallingLaw OfTwoDirections() {
  return {*FindLaw(L::name),
          *FindLaw(Asymmetric::name),
          AsymmetricStribeck::name,
          FallingPlacesOf<L>(),
          &TableOf<L>,
          Eigen::Vector4d(0, 0, 0, 1),
          kStaticRiseRow.name,
          [](const double* p) { return std::min(p[1], p[2]); },
          [](const double* p) { return 0.5 * (p[1] + p[2]) + p[3]; },
          [](double* p, double least, double most) {
            const double coulomb = std::min(p[1], p[2]);
            p[3] = std::clamp(p[3], (least - 1) * coulomb, (most - 1) * coulomb);
          }};
}

}  // namespace

const FallingLaw& FindFallingLaw(std::string_view name) {
  static const FallingLaw laws[] = {OfOneLevel<Stribeck>(), OfTwoDirections<AsymmetricStribeck>(),
                                    OfOneLevel<LuGre>(), OfTwoDirections<AsymmetricLuGre>()};
  const auto* found =
      std::ranges::find_if(laws, [&](const FallingLaw& one) { return one.law.name == name; });
  assert(found != std::end(laws));
  return *found;
}

std::vector<FitPoint> BestFirst(std::vector<FitPoint> points) {
  std::ranges::stable_sort(points, {}, &FitPoint::squares);
  return points;
}

std::vector<Iterate> ScanTrace(const FallingLaw& law, double exponent,
                               const std::vector<FitPoint>& points, double deviation,
                               Eigen::Index count) {
  std::vector<Iterate> trace;
  for (const FitPoint& point : points) {
    const Eigen::VectorXd values = law.values(point.x, exponent);
    const double rmse = deviation * std::sqrt(point.squares / static_cast<double>(count));
    trace.push_back({static_cast<int>(trace.size()),
                     {values.begin(), values.begin() + law.places.gain()},
                     rmse});
  }
  return trace;
}

void SetFallingModel(const FallingLaw& law, double exponent, const FallingPlaces& at,
                     const Eigen::VectorXd& x, const LogSamples& measurements, Fit& fit) {
  const Eigen::VectorXd values = law.values(x, exponent);
  fit.model.friction = FrictionOf(law.law, values, measurements);
  fit.parameters = WithValues(LawUnknowns(law.law, values.size(), UnitsOf(measurements)), values);
  // vs is fitted by its logarithm; an exponent, which follows the rows that are in x, was given
  fit.parameters[at.log_vs()].coordinate = Coordinate::logarithm;
  for (Unknown& given : std::span(fit.parameters).subspan(at.gain())) {
    given.estimated = false;
  }
  if (at.heat == 0) return;
  fit.model.friction.thermal = at.ThermalAt(x);
  Append(HeatParameters(*fit.model.friction.thermal, measurements), fit);
}

}  // namespace warmjoint

#include <cmath>

#include "identification/uncertainty/tails.h"
#include "tools/figures/axes.h"
#include "tools/figures/fit_panels.h"

namespace warmjoint::figures {
namespace {

constexpr double kOutermost = 0.01;      // share of the samples, at either end
constexpr double kThinnestBand = 0.008;  // of the axis: about a line's width

}  // namespace

Plot WarmUpCurve(const FitView& view) {
  // (tau - Fn) sign v, Eq. (23), where Fn sign v = F sign v - E
  const Eigen::VectorXd direction = view.velocity.array().sign();
  const Eigen::VectorXd observed =
      KeptOf(view, (view.torque - view.fitted).cwiseProduct(direction) + view.energy);
  const Eigen::VectorXd time = view.time / TimeUnit(view);

  Plot plot;
  plot.series.push_back(
      {"(torque − F_{n}) · sign(v)", Hue::grey, Scatter{KeptOf(view, time), observed, 1.1}});
  if (view.energy_std.size() > 0) {
    const Eigen::VectorXd reach = kNormal95 * view.energy_std;
    const auto [lowest, highest] = RangeOf({observed});
    // a band as thin as its line cannot be seen
    if (2 * reach.maxCoeff() > kThinnestBand * (highest - lowest)) {
      plot.series.push_back(
          {"95 %", Hue::vermilion, Band{time, view.energy - reach, view.energy + reach, 0.35}});
    }
  }
  plot.series.push_back({view.is_void() ? "E (void)" : "E", Hue::vermilion,
                         Line{time, view.energy, 2.0, FitDash(view)}});
  plot.x = {TimeLabel(view), 0, time.tail(1)[0], Scale::linear, {}};
  // samples of reversals may leave the picture, E may not
  const Axis bulk = BulkAxis("", {observed}, kOutermost);
  plot.y = LinearAxis(TorqueLabel(view, "change of the level, E"),
                      {Eigen::Vector2d(bulk.lower, bulk.upper), view.energy});
  return plot;
}

}  // namespace warmjoint::figures

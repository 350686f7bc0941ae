// Normalised kernels beside plain ones.
#include <fmt/core.h>
#include <warmjoint/friction.h>

#include "identification/ridge/ridge.h"
#include "models/foundation/random_stream.h"
#include "models/friction/evaluate_map.h"
#include "tools/figures/axes.h"
#include "tools/figures/estimate_figures.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kReach = 2;     // |t| of the data
constexpr double kView = 4;      // |t| of the picture
constexpr int kCentres = 6;      // kernels
constexpr Index kSamples = 60;   // data
constexpr Index kPoints = 401;   // of each curve
constexpr double kNoise = 0.05;  // standard deviation

double TheFunction(double t) { return 0.3 * t * t - 0.5; }

/// Kernels at each t: [N x K].
MatrixXd KernelsAt(const GaussianAxis& axis, KernelKind kind, const VectorXd& t) {
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> phi(t.size(), axis.size());
  for (Index i = 0; i < t.size(); ++i) AxisKernels(axis, kind, t[i], &phi(i, 0));
  return phi;
}

/// The fitted function at t, with the strength of the prior that the data make most likely.
VectorXd FitAt(const GaussianAxis& axis, KernelKind kind, const VectorXd& seen,
               const VectorXd& values, const VectorXd& t) {
  NormalEquations normal(static_cast<Index>(axis.size()));
  normal.Add(KernelsAt(axis, kind, seen), values);
  const VectorXd weights = Ridge(normal, 0).Solve(MaximiseEvidence(normal, 0).strength());
  return KernelsAt(axis, kind, t) * weights;
}

Plot KernelPanel(const GaussianAxis& axis, KernelKind kind, Hue hue, const VectorXd& t) {
  const MatrixXd phi = KernelsAt(axis, kind, t);
  Plot plot;
  for (Index k = 0; k < phi.cols(); ++k) {
    plot.series.push_back({"", hue, Line{t, phi.col(k), 1.4}});
  }
  plot.x = {"t", -kView, kView};
  plot.y = {"kernel", 0, 1.05};
  return plot;
}

}  // namespace

Figure MakeKernels() {
  // noisy values of a known function, the same in every run
  RandomStream random({3, 0}, Stream::torque_noise);
  const VectorXd seen = VectorXd::LinSpaced(kSamples, -kReach, kReach);
  VectorXd values = seen.unaryExpr(&TheFunction);
  for (double& value : values) value += kNoise * random.Normal();
  // both kinds of kernels are fitted to them and looked at beyond the data
  const GaussianAxis axis = EvenAxis(-kReach, kReach, kCentres);
  const VectorXd t = VectorXd::LinSpaced(kPoints, -kView, kView);
  const VectorXd plain = FitAt(axis, KernelKind::plain, seen, values, t);
  const VectorXd normalised = FitAt(axis, KernelKind::normalised, seen, values, t);

  // the function, the data and both fits
  Plot fits;
  fits.series = {{"0.3 t² − 0.5", Hue::text, Line{t, t.unaryExpr(&TheFunction), 1.2, Dash::dashed}},
                 {"data", Hue::grey, Scatter{seen, values, 2}},
                 {"plain kernels", Hue::orange, Line{t, plain, 2}},
                 {"normalised kernels", Hue::blue, Line{t, normalised, 2}}};
  fits.x = {"t", -kView, kView};
  fits.y = {"value", -0.7, 1.8};

  // what the picture is to teach, and what each of them says where there are no data
  Figure figure{
      "kernels", "Normalised kernels keep their value beyond the data",
      fmt::format(
          "{} Gaussian kernels fitted to {} noisy values of 0.3 t² − 0.5 between −{} and {}",
          kCentres, kSamples, kReach, kReach),
      fmt::format(
          "At t = {0}, beyond the data, the plain kernels say {1} and the normalised ones {2}; at "
          "the edge of the data the function is {3}.",
          kView, SignificantText(plain[kPoints - 1], 2),
          SignificantText(normalised[kPoints - 1], 2), SignificantText(TheFunction(kReach), 2))};
  // below the fits the kernels of both kinds
  figure.height = 620;
  figure.rows = {1.6, 1};
  figure.columns = {1, 1};
  figure.panels = {
      {"", fits, 0, 0, 1, 2},
      {"Plain kernels", KernelPanel(axis, KernelKind::plain, Hue::orange, t), 1, 0},
      {"Normalised kernels: their sum is 1",
       KernelPanel(axis, KernelKind::normalised, Hue::blue, t), 1, 1},
  };
  return figure;
}

}  // namespace warmjoint::figures

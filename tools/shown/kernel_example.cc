#include "tools/shown/kernel_example.h"

#include <warmjoint/friction.h>

#include <nlohmann/json.hpp>

#include "identification/model/normal_equations.h"
#include "identification/model/ridge.h"
#include "models/foundation/random_stream.h"
#include "models/friction/evaluate_map.h"

namespace warmjoint::shown {
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

}  // namespace

Tree KernelFacts(ShownData& data) {
  // noisy values of a known function, the same in every run
  RandomStream random({3, 0}, Stream::torque_noise);
  const VectorXd seen = VectorXd::LinSpaced(kSamples, -kReach, kReach);
  VectorXd values = seen.unaryExpr(&TheFunction);
  for (double& value : values) value += kNoise * random.Normal();
  // both kinds of kernels are fitted to them and looked at beyond the data
  const GaussianAxis axis = EvenAxis(-kReach, kReach, kCentres);
  const VectorXd t = VectorXd::LinSpaced(kPoints, -kView, kView);
  Tree facts{{"reach", kReach},
             {"t", data.Hold(t)},
             {"truth", data.Hold(VectorXd(t.unaryExpr(&TheFunction)))},
             {"seen", data.Hold(seen)},
             {"values", data.Hold(values)}};
  for (const auto& [name, kind] :
       {std::pair("plain", KernelKind::plain), std::pair("normalised", KernelKind::normalised)}) {
    facts["fits"][name] = data.Hold(FitAt(axis, kind, seen, values, t));
    facts["kernels"][name] = data.Hold(KernelsAt(axis, kind, t));
  }
  return facts;
}

}  // namespace warmjoint::shown

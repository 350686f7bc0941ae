#include "identification/model/solve.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>
#include <utility>

#include "identification/kept_rows.h"
#include "identification/model/minimise.h"
#include "identification/model/model_squares.h"
#include "identification/model/normal_equations.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostIterations = 40;
/// Drop of the cost, in units of the noise, at which a fit has converged. Why: such a drop changes no parameter by 1 % of its deviation.
constexpr double kRests = 1e-4;

}  // namespace

NoiseScale NoiseScaleOf(const VectorXd& e) {
  NoiseScale noise;
  const Index n = e.size();
  if (n < 8) return noise;
  noise.variance = std::max(e.squaredNorm() / static_cast<double>(n), 1e-300);
  // autocorrelations by the square of the spectrum, padded so that the ends do not overlap,
  // to a power of two, for which the transform is fast
  std::size_t length = 16;
  while (length < static_cast<std::size_t>(2 * n)) length *= 2;
  std::vector<double> padded(length, 0.0);
  VectorXd::Map(padded.data(), n) = e.array() - e.mean();
  std::vector<std::complex<double>> spectrum;
  Eigen::FFT<double> fft;
  fft.fwd(spectrum, padded);
  for (auto& one : spectrum) one = std::norm(one);
  fft.inv(padded, spectrum);
  if (!(padded[0] > 0)) return noise;
  for (Index k = 1; k < n / 4; ++k) {
    const double r = padded[static_cast<std::size_t>(k)] / padded[0];
    if (r < .05) break;
    noise.correlation += 2 * r;
  }
  return noise;
}

SquaresProblem WithinLimits(const Model& model, const std::vector<Index>& held) {
  SquaresProblem problem;
  problem.held = held;
  problem.rests = kRests;
  const Index p = model.size();
  problem.lower.resize(p);
  problem.upper.resize(p);
  problem.largest_step.resize(p);
  for (Index i = 0; i < p; ++i) {
    const Unknown& row = model.table[static_cast<std::size_t>(i)];
    // in the coordinate of the fit
    const bool logarithm = row.coordinate == Coordinate::logarithm;
    problem.lower[i] = logarithm ? std::log(std::max(row.lower, 0.0)) : row.lower;
    problem.upper[i] = logarithm ? std::log(row.upper) : row.upper;
    problem.largest_step[i] = row.largest_step;
  }
  return problem;
}

SolvedModel Solve(const Model& model, const ModelSamples& samples, VectorXd x,
                  const std::vector<Index>& held) {
  ModelSquares squares(model, samples);
  const Selection used{samples.keep, {}};
  const auto noise_at = [&](const VectorXd& at) {
    return NoiseScaleOf(Kept(squares.ResidualAt(at), used));
  };
  SquaresProblem problem = WithinLimits(model, held);
  SolvedModel solved;
  solved.noise = noise_at(x);
  // one step by the noise of the fit so far, until step and noise no longer change
  problem.most_iterations = 1;
  for (; solved.iterations < kMostIterations && !solved.converged; ++solved.iterations) {
    const double scale = solved.noise.scale();
    problem.sums = [&](const VectorXd& at) { return squares.At(at, scale); };
    Minimum step = Minimise(problem, std::move(x));
    x = std::move(step.x);
    solved.at_bound = std::move(step.at_bound);
    solved.noise = noise_at(x);
    const double change = std::abs(std::log(solved.noise.scale() / scale));
    solved.converged = step.fell < kRests && (change < 1e-3 || step.fell == 0);
  }
  solved.residual = squares.ResidualAt(x);
  solved.gram = squares.OfData(x).gram;
  solved.x = std::move(x);
  return solved;
}

Minimum SolveAtNoise(const Model& model, const ModelSamples& samples, double variance, VectorXd x) {
  ModelSquares squares(model, samples);
  SquaresProblem problem = WithinLimits(model);
  problem.rests = SquaresProblem().rests;
  const auto count = static_cast<double>(samples.keep.count());
  problem.least = count * RoundingVariance(samples.torque) / variance;
  problem.sums = [&](const VectorXd& at) { return squares.At(at, variance); };
  return Minimise(problem, std::move(x));
}

LinearMinimum SolveLinear(const Model& model, const ModelSamples& samples) {
  // at 0 the torque is what is left
  const Index p = model.size();
  const ModelRows::Rows rows = RowsToFit(ModelAt(model, VectorXd::Zero(p)), samples);
  const MatrixXd columns = rows.leftCols(p);
  const VectorXd torque = rows.col(p);
  LinearMinimum found{SolveLeastSquares(columns, torque)};
  if (found.solved.rank == p) {
    found.squares = (torque - columns * found.solved.solution).squaredNorm();
  }
  return found;
}

}  // namespace warmjoint

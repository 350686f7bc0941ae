#include "identification/model/solve.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/FFT>

#include "identification/fit_data.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostIterations = 40;
/// Drop of the cost, in units of the noise, at which a fit rests. Why: it moves no parameter by 1 % of its deviation.
constexpr double kRests = 1e-4;

/// What a step is made of.
struct Normals {
  MatrixXd h;       // [P x P]
  VectorXd b;       // [P]
  double cost = 0;  // at a given scale
};

double PriorCost(const Model& model, const VectorXd& x) {
  return (x - model.PriorMean()).cwiseAbs2().dot(model.PriorPrecision());
}

double Cost(const Model& model, const VectorXd& x, const VectorXd& e, double scale) {
  return e.squaredNorm() / scale + PriorCost(model, x);
}

/// Where the eigenvalues of a matrix scaled to a unit diagonal count as 0.
constexpr double kNoInformation = 1e-12;  // why: the rounding of some 1e4 samples' products

struct Scaled {
  VectorXd scale;
  MatrixXd vectors;
  VectorXd inverse;  // of the eigenvalues; 0 where there is no information
};

Scaled Decompose(const MatrixXd& h) {
  Scaled found;
  found.scale = h.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(found.scale.asDiagonal() * h *
                                                       found.scale.asDiagonal());
  found.vectors = solver.eigenvectors();
  const VectorXd& values = solver.eigenvalues();
  const double least = kNoInformation * values.tail(1)[0];
  found.inverse = (values.array() > least).select(values.cwiseMax(least).cwiseInverse(), 0.0);
  return found;
}

/// Derivatives of the kept samples, with 0 for what is held.
MatrixXd KeptRows(const MatrixXd& derivatives, const Selection& used,
                  const std::vector<Index>& held) {
  MatrixXd rows = Kept(derivatives, used);
  for (const Index column : held) rows.col(column).setZero();
  return rows;
}

/// The step that the normal equations ask for, shortened as a whole so that no unknown moves farther than it may.
VectorXd StepOf(const Model& model, MatrixXd h, VectorXd b, const std::vector<Index>& held) {
  for (const Index i : held) {
    h.row(i).setZero();
    h.col(i).setZero();
    h(i, i) = 1;
    b[i] = 0;
  }
  VectorXd step = SolveScaled(h, b);
  for (Index i = 0; i < step.size(); ++i) {
    const double most = model.table[static_cast<std::size_t>(i)].largest_step;
    step[i] = std::clamp(step[i], -most, most);
  }
  return step;
}

void Clamp(const Model& model, VectorXd& x) {
  for (Index i = 0; i < x.size(); ++i) {
    const Unknown& row = model.table[static_cast<std::size_t>(i)];
    x[i] = std::clamp(x[i], row.lower, row.upper);
  }
}

/// Unknowns at a bound that the cost would push farther out. b: [P] minus half the gradient of the cost
std::vector<Index> PushedOut(const Model& model, const VectorXd& x, const VectorXd& b) {
  std::vector<Index> pushed;
  for (Index i = 0; i < x.size(); ++i) {
    const Unknown& row = model.table[static_cast<std::size_t>(i)];
    if ((x[i] <= row.lower && b[i] < 0) || (x[i] >= row.upper && b[i] > 0)) pushed.push_back(i);
  }
  return pushed;
}

}  // namespace

VectorXd SolveScaled(const MatrixXd& h, const VectorXd& b) {
  const Scaled d = Decompose(h);
  const VectorXd in = d.vectors.transpose() * d.scale.cwiseProduct(b);
  return d.scale.cwiseProduct(d.vectors * d.inverse.cwiseProduct(in));
}

MatrixXd InverseScaled(const MatrixXd& h) {
  const Scaled d = Decompose(h);
  const MatrixXd root = d.scale.asDiagonal() * d.vectors * d.inverse.cwiseSqrt().asDiagonal();
  return root * root.transpose();
}

NoiseScale NoiseScaleOf(const VectorXd& e) {
  NoiseScale noise;
  const Index n = e.size();
  if (n < 8) return noise;
  noise.variance = std::max(e.squaredNorm() / static_cast<double>(n), 1e-300);
  // autocorrelations by the square of the spectrum, padded so that the ends do not meet
  // to a power of two, which the transform is fast for
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

SolvedModel Solve(const Model& model, const ModelSamples& samples, VectorXd x,
                  const std::vector<Index>& held) {
  const Selection used{samples.keep, {}};
  const VectorXd precision = model.PriorPrecision(), mean = model.PriorMean();
  SolvedModel solved;
  ModelRows rows = model.Evaluate(x);
  VectorXd e = Kept(VectorXd(samples.torque - rows.force), used);
  solved.noise = NoiseScaleOf(e);
  for (; solved.iterations < kMostIterations && !solved.converged; ++solved.iterations) {
    const double scale = solved.noise.scale();
    const MatrixXd j = KeptRows(rows.derivatives, used, held);
    MatrixXd h = MatrixXd::Zero(model.size(), model.size());
    h.selfadjointView<Eigen::Lower>().rankUpdate(j.transpose(), 1 / scale);
    h.triangularView<Eigen::StrictlyUpper>() = h.transpose();
    h.diagonal() += precision;
    const VectorXd b = j.transpose() * e / scale - precision.cwiseProduct(x - mean);
    solved.at_bound = PushedOut(model, x, b);
    std::vector<Index> fixed = held;
    fixed.insert(fixed.end(), solved.at_bound.begin(), solved.at_bound.end());
    const VectorXd step = StepOf(model, h, b, fixed);

    // halved until the cost falls
    const double before = Cost(model, x, e, scale);
    double drop = 0;
    for (double share = 1; share > 1e-3; share /= 2) {
      VectorXd next = x + share * step;
      Clamp(model, next);
      ModelRows there = model.Evaluate(next);
      const VectorXd left = Kept(VectorXd(samples.torque - there.force), used);
      const double cost = Cost(model, next, left, scale);
      if (!(cost < before)) continue;
      drop = before - cost;
      x = std::move(next);
      rows = std::move(there);
      e = left;
      break;
    }
    const NoiseScale now = NoiseScaleOf(e);
    const double change = std::abs(std::log(now.scale() / scale));
    solved.noise = now;
    solved.converged = drop < kRests && (change < 1e-3 || drop == 0);
  }
  solved.x = x;
  solved.residual = samples.torque - rows.force;
  return solved;
}

SolvedCovariance CovarianceOf(const Model& model, const ModelSamples& samples,
                              const SolvedModel& solved) {
  const Selection used{samples.keep, {}};
  const MatrixXd j = Kept(model.Evaluate(solved.x).derivatives, used);
  const VectorXd e = Kept(solved.residual, used), time = Kept(samples.time, used);
  const double scale = solved.noise.scale();
  const VectorXd precision = model.PriorPrecision();
  MatrixXd h = MatrixXd::Zero(model.size(), model.size());
  h.selfadjointView<Eigen::Lower>().rankUpdate(j.transpose(), 1 / scale);
  h.triangularView<Eigen::StrictlyUpper>() = h.transpose();
  const MatrixXd data = h;
  h.diagonal() += precision;

  // scores of each block of time
  SolvedCovariance found;
  const double length = samples.time.tail(1)[0] - samples.time[0];
  const double step = length / static_cast<double>(samples.time.size() - 1);
  found.block =
      std::clamp(4 * solved.noise.correlation * step, std::min(.5, length / 20), length / 20);
  MatrixXd meat = MatrixXd::Zero(model.size(), model.size());
  VectorXd score = VectorXd::Zero(model.size());
  double blocks = 0;
  for (Index i = 0; i < e.size();) {
    const double block = std::floor((time[i] - samples.time[0]) / found.block);
    score.setZero();
    for (; i < e.size() && std::floor((time[i] - samples.time[0]) / found.block) == block; ++i) {
      score += j.row(i).transpose() * (e[i] / scale);
    }
    meat += score * score.transpose();
    ++blocks;
  }
  meat *= blocks / std::max(blocks - 1, 1.0);
  meat.diagonal() += precision;
  const MatrixXd inverse = InverseScaled(h);
  found.covariance = inverse * meat * inverse;
  found.degrees_of_freedom = std::max(blocks - 1, 3.0);
  found.effective_parameters = (inverse * data).trace();
  return found;
}

}  // namespace warmjoint

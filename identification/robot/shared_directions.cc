#include "identification/robot/shared_directions.h"

#include <algorithm>
#include <cmath>

#include "identification/fit_data.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostIterations = 40;
/// Drop of the cost at which the fit rests: no unknown moves by 1 % of its deviation.
constexpr double kRests = 1e-4;

/// A joint's equations at its own unknowns and z, with the own ones eliminated.
struct Eliminated {
  std::vector<Index> own;  // unknowns that are not of z
  MatrixXd projected;      // [own x r] own = step - projected * step of z
  VectorXd step;           // [own] with z at rest
  double drop = 0;         // of the cost by that step
  MatrixXd h;              // [r x r] of the data
  VectorXd b;              // [r]
  MatrixXd meat;           // [r x r] of the scores
};

std::vector<Index> OwnOf(const JointFit& fit) {
  const Slice& z = fit.at.given.z;
  std::vector<Index> own;
  for (Index i = 0; i < fit.model.size(); ++i) {
    const bool held = std::ranges::find(fit.solved.at_bound, i) != fit.solved.at_bound.end();
    if (!held && (i < z.begin || i >= z.end())) own.push_back(i);
  }
  return own;
}

/// Mean of the joints' log gains.
double CommonGain(const std::vector<JointFit>& fits, const std::vector<VectorXd>& x) {
  double sum = 0;
  for (std::size_t j = 0; j < fits.size(); ++j) sum += x[j][fits[j].at.given.log_gain];
  return sum / static_cast<double>(fits.size());
}

/// common_gain: about which the joint's log gain has its prior.
Eliminated Eliminate(const JointFit& fit, const JointColumns& c, const VectorXd& x,
                     double common_gain) {
  Eliminated e;
  const Selection used{c.samples.keep, {}};
  const ModelRows rows = fit.model.Evaluate(x);
  const VectorXd left = Kept(VectorXd(c.samples.torque - rows.force), used);
  const MatrixXd j = Kept(rows.derivatives, used);
  const double scale = fit.solved.noise.scale();
  const VectorXd precision = fit.model.PriorPrecision();
  VectorXd mean = fit.model.PriorMean();
  mean[fit.at.given.log_gain] = common_gain;
  e.own = OwnOf(fit);
  const Slice& z = fit.at.given.z;
  const MatrixXd of_own = j(Eigen::all, e.own), of_z = j.middleCols(z.begin, z.size);

  MatrixXd h = of_own.transpose() * of_own / scale;
  h.diagonal() += precision(e.own);
  const VectorXd b =
      of_own.transpose() * left / scale - precision(e.own).cwiseProduct(x(e.own) - mean(e.own));
  const MatrixXd between = of_own.transpose() * of_z / scale, inverse = InverseScaled(h);
  e.projected = inverse * between;
  e.step = inverse * b;
  e.drop = b.dot(e.step);
  e.h = of_z.transpose() * of_z / scale - between.transpose() * e.projected;
  e.b = of_z.transpose() * left / scale - e.projected.transpose() * b;

  const MatrixXd scores = (left / scale).asDiagonal() * (of_z - of_own * e.projected);
  const VectorXd time = Kept(c.samples.time, used);
  e.meat = ScatterOverBlocks(scores, time, time[0], fit.known.block).squares;
  // what a joint's own priors leave open
  e.meat += e.projected.transpose() * precision(e.own).asDiagonal() * e.projected;
  return e;
}

}  // namespace

SharedDirections FitShared(const std::vector<JointFit>& fits,
                           const std::vector<JointColumns>& columns) {
  SharedDirections shared;
  const Index r = fits.front().at.given.z.size;
  shared.z = VectorXd::Zero(r);
  std::vector<VectorXd> x;
  for (const JointFit& fit : fits) {
    x.push_back(fit.solved.x);
    x.back().segment(fit.at.given.z.begin, r).setZero();
  }
  for (int i = 0; i < kMostIterations && !shared.converged; ++i) {
    std::vector<Eliminated> joints;
    MatrixXd h = MatrixXd::Identity(r, r), meat = h;
    VectorXd b = -shared.z;
    double drop = 0;
    const double gain = CommonGain(fits, x);
    for (std::size_t j = 0; j < fits.size(); ++j) {
      const Eliminated& e = joints.emplace_back(Eliminate(fits[j], columns[j], x[j], gain));
      h += e.h;
      b += e.b;
      meat += e.meat;
      drop += e.drop;
    }
    const VectorXd step = SolveScaled(h, b);
    // as far as every gain may move
    double share = 1;
    std::vector<VectorXd> own;
    for (std::size_t j = 0; j < fits.size(); ++j) {
      own.emplace_back(joints[j].step - joints[j].projected * step);
      for (Index k = 0; k < own[j].size(); ++k) {
        const auto row = static_cast<std::size_t>(joints[j].own[static_cast<std::size_t>(k)]);
        share = std::min(share, fits[j].model.table[row].largest_step / std::abs(own[j][k]));
      }
    }
    for (std::size_t j = 0; j < fits.size(); ++j) {
      x[j](joints[j].own) += share * own[j];
      x[j].segment(fits[j].at.given.z.begin, r) += share * step;
    }
    shared.z += share * step;
    shared.converged = share == 1 && step.dot(h * step) + drop < kRests;
    const MatrixXd inverse = InverseScaled(h);
    shared.covariance = inverse * meat * inverse;
  }
  shared.degrees_of_freedom = fits.front().known.degrees_of_freedom;
  for (const JointFit& fit : fits) {
    shared.degrees_of_freedom = std::min(shared.degrees_of_freedom, fit.known.degrees_of_freedom);
  }
  return shared;
}

}  // namespace warmjoint

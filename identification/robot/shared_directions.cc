#include "identification/robot/shared_directions.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "identification/fit_data.h"
#include "identification/model/minimise.h"
#include "identification/model/normal_equations.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Fall of the squares that the next step promises at which the fit has converged: no unknown changes by 1 % of its deviation.
constexpr double kRests = 1e-4;

/// The rows of a joint's kept samples at a point, over the noise's standard deviation.
struct JointSays {
  MatrixXd derivatives;  // [n x m] by the unknowns that the joint has of all
  VectorXd left;         // [n]
};

/// The squares of all joints over x = [own unknowns of each joint, z], with all priors.
class SharedSquares {
 public:
  SharedSquares(const std::vector<JointFit>& fits, const std::vector<JointColumns>& columns)
      : fits_(fits), columns_(columns), directions_(fits.front().at.given.z.size) {
    for (const JointFit& fit : fits) {
      Places own;
      const Slice& z = fit.at.given.z;
      for (Index i = 0; i < fit.model.size(); ++i) {
        const bool held = std::ranges::find(fit.solved.at_bound, i) != fit.solved.at_bound.end();
        if (!held && (i < z.begin || i >= z.end())) own.Add(i, own_++);
      }
      places_.push_back(std::move(own));
    }
    for (std::size_t j = 0; j < fits.size(); ++j) {
      for (Index k = 0; k < directions_; ++k)
        places_[j].Add(fits[j].at.given.z.begin + k, own_ + k);
    }
  }

  /// The place of z in x.
  Slice z() const { return {own_, directions_}; }

  /// Each joint's fit, and a description that is right.
  VectorXd Start() const {
    VectorXd x = VectorXd::Zero(own_ + directions_);
    for (std::size_t j = 0; j < fits_.size(); ++j) {
      x(places_[j].here) = fits_[j].solved.x(places_[j].of_joint);
    }
    z().In(x).setZero();
    return x;
  }

  SquaresProblem Problem() const {
    constexpr double any = std::numeric_limits<double>::infinity();
    SquaresProblem problem;
    problem.sums = [this](const VectorXd& x) { return At(x); };
    problem.rests = kRests;
    problem.lower = VectorXd::Constant(own_ + directions_, -any);
    problem.upper = problem.largest_step = -problem.lower;
    for (std::size_t j = 0; j < fits_.size(); ++j) {
      for (std::size_t k = 0; k < places_[j].here.size(); ++k) {
        const Index here = places_[j].here[k];
        if (here >= own_) continue;
        const Unknown& row = fits_[j].model.table[static_cast<std::size_t>(places_[j].of_joint[k])];
        problem.lower[here] = row.lower;
        problem.upper[here] = row.upper;
        problem.largest_step[here] = row.largest_step;
      }
    }
    return problem;
  }

  /// The scatter of the scores in each joint's blocks of time, and of the priors. [p x p]
  MatrixXd Scatter(const VectorXd& x) const {
    MatrixXd sum = OfPriors(x).gram;
    for (std::size_t j = 0; j < fits_.size(); ++j) {
      const JointSays says = Says(j, x);
      const ModelSamples& samples = columns_[j].samples;
      const VectorXd time = Kept(samples.time, {samples.keep, {}});
      sum(places_[j].here, places_[j].here) +=
          ScatterOverBlocks(says.left.asDiagonal() * says.derivatives, time, time[0],
                            fits_[j].uncertainty.block)
              .squares;
    }
    return sum;
  }

 private:
  /// Unknowns of a joint's model, and their places in x.
  struct Places {
    std::vector<Index> of_joint, here;

    void Add(Index joint, Index place) {
      of_joint.push_back(joint);
      here.push_back(place);
    }
  };

  /// The unknowns of joint j's model.
  VectorXd Of(std::size_t j, const VectorXd& x) const {
    VectorXd of_joint = fits_[j].solved.x;
    of_joint(places_[j].of_joint) = x(places_[j].here);
    return of_joint;
  }

  JointSays Says(std::size_t j, const VectorXd& x) const {
    const ModelSamples& samples = columns_[j].samples;
    const Selection used{samples.keep, {}};
    const ModelRows rows = fits_[j].model.Evaluate(Of(j, x));
    const double scale = std::sqrt(fits_[j].solved.noise.scale());
    return {Kept(rows.derivatives, used)(Eigen::all, places_[j].of_joint) / scale,
            Kept(VectorXd(samples.torque - rows.force), used) / scale};
  }

  /// The rows of the priors: of each joint's own unknowns and, once, of z. The priors of log gains are about their mean.
  RowSums OfPriors(const VectorXd& x) const {
    const Index p = x.size(), n = std::ssize(fits_);
    MatrixXd rows = MatrixXd::Identity(p, p);
    VectorXd precision = VectorXd::Zero(p), mean = precision;
    z().In(precision).setOnes();
    std::vector<Index> gains;
    double sum = 0;
    for (std::size_t j = 0; j < fits_.size(); ++j) {
      const VectorXd own = fits_[j].model.PriorPrecision(), about = fits_[j].model.PriorMean();
      sum += Of(j, x)[fits_[j].at.given.log_gain];
      for (std::size_t k = 0; k < places_[j].here.size(); ++k) {
        const Index here = places_[j].here[k], row = places_[j].of_joint[k];
        if (here >= own_) continue;
        precision[here] = own[row];
        mean[here] = about[row];
        if (row == fits_[j].at.given.log_gain) gains.push_back(here);
      }
    }
    VectorXd off = x - mean;
    for (const Index one : gains) {
      off[one] = x[one] - sum / static_cast<double>(n);
      for (const Index other : gains) rows(one, other) -= 1 / static_cast<double>(n);
    }
    const MatrixXd weighed = precision.asDiagonal() * rows;
    return {rows.transpose() * weighed, -weighed.transpose() * off, off.cwiseAbs2().dot(precision)};
  }

  RowSums At(const VectorXd& x) const {
    RowSums sums = OfPriors(x);
    for (std::size_t j = 0; j < fits_.size(); ++j) {
      const JointSays says = Says(j, x);
      const std::vector<Index>& here = places_[j].here;
      sums.gram(here, here) += GramOf(says.derivatives);
      sums.product(here) += says.derivatives.transpose() * says.left;
      sums.squares += says.left.squaredNorm();
    }
    return sums;
  }

  const std::vector<JointFit>& fits_;
  const std::vector<JointColumns>& columns_;
  Index directions_, own_ = 0;
  std::vector<Places> places_;  // of each joint
};

}  // namespace

SharedDirections FitShared(const std::vector<JointFit>& fits,
                           const std::vector<JointColumns>& columns) {
  const SharedSquares squares(fits, columns);
  const Minimum found = Minimise(squares.Problem(), squares.Start());
  const MatrixXd inverse = InverseScaled(found.sums.gram);
  const Slice z = squares.z();
  const MatrixXd of_z = inverse.middleRows(z.begin, z.size);

  SharedDirections shared;
  shared.z = z.Of(found.x);
  shared.covariance = of_z * squares.Scatter(found.x) * of_z.transpose();
  shared.converged = found.converged;
  shared.degrees_of_freedom = fits.front().uncertainty.degrees_of_freedom;
  for (const JointFit& fit : fits) {
    shared.degrees_of_freedom =
        std::min(shared.degrees_of_freedom, fit.uncertainty.degrees_of_freedom);
  }
  return shared;
}

}  // namespace warmjoint

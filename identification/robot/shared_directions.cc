#include "identification/robot/shared_directions.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "identification/fit/fit_data.h"
#include "identification/model/minimise.h"
#include "identification/model/normal_equations.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Deviation of a log gain from which on the unit says nothing of it (PriorOfGain).
constexpr double kFreeSpread = 1;

/// The rows of a joint's kept samples at a point, over the noise's standard deviation.
struct JointSays {
  MatrixXd derivatives;  // [n x m] by the unknowns that the joint has of all
  VectorXd left;         // [n]
};

/// The squares of all joints over x = [own unknowns of each joint, z], with all priors.
class SharedSquares {
 public:
  SharedSquares(const std::vector<JointFit>& fits, const std::vector<JointColumns>& columns)
      : fits_(fits), columns_(columns) {
    for (const JointFit& fit : fits) {
      const Slice z = fit.At(Role::direction);
      Places& own = places_.emplace_back();
      for (Index i = 0; i < fit.model.size(); ++i) {
        const bool held = std::ranges::find(fit.solved.at_bound, i) != fit.solved.at_bound.end();
        if (held || (i >= z.begin && i < z.end())) continue;
        if (RowOf(fit, i).role == Role::scale && RowOf(fit, i).prior->deviation >= kFreeSpread) {
          gains_.push_back(all_.size());
        }
        own.Add(i, all_.Append({RowOf(fit, i)}).begin);
      }
      TakeGroups(fit.model, own);
    }
    // the directions are those of every joint
    z_.begin = all_.size();
    for (std::size_t j = 0; j < fits.size(); ++j) {
      const Slice z = fits[j].At(Role::direction);
      for (Index k = 0; k < z.size; ++k) {
        if (j == 0) all_.Append({RowOf(fits[j], z.begin + k)});
        places_[j].Add(z.begin + k, z_.begin + k);
      }
    }
    z_.size = all_.size() - z_.begin;
  }

  /// The place of z in x.
  const Slice& z() const { return z_; }

  /// Each joint's fit, and the z that their normal densities have together: the prior of each once.
  VectorXd Start() const {
    VectorXd x = VectorXd::Zero(all_.size());
    MatrixXd precision = MatrixXd::Identity(z_.size, z_.size);
    VectorXd product = VectorXd::Zero(z_.size);
    for (std::size_t j = 0; j < fits_.size(); ++j) {
      const JointFit& fit = fits_[j];
      x(places_[j].here) = fit.solved.x(places_[j].of_joint);
      const MatrixXd h = fit.solved.gram / fit.solved.noise.scale() + fit.model.PriorPrecision();
      const Slice own = fit.At(Role::direction);
      const MatrixXd of_z = InverseScaled(own.Block(InverseScaled(h)));
      precision += of_z - MatrixXd::Identity(z_.size, z_.size);
      product += of_z * own.Of(fit.solved.x);
    }
    z().In(x) = SolveScaled(precision, product);
    return x;
  }

  SquaresProblem Problem() const {
    SquaresProblem problem = WithinLimits(all_);
    problem.sums = [this](const VectorXd& x) { return At(x); };
    return problem;
  }

  /// J^T R J of the noise of each joint's fit, and of the priors. [p x p]
  MatrixXd Scatter(const VectorXd& x) const {
    MatrixXd sum = OfPriors(x).gram;
    for (std::size_t j = 0; j < fits_.size(); ++j) {
      const MatrixXd rows = Says(j, x).derivatives;
      sum(places_[j].here, places_[j].here) +=
          ScatterThrough(fits_[j].uncertainty.noise, rows, {columns_[j].samples.keep, {}}) /
          fits_[j].solved.noise.scale();
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
    /// The place in x of an unknown of the joint, where it has one.
    std::optional<Index> Find(Index joint) const {
      const auto found = std::ranges::find(of_joint, joint);
      if (found == of_joint.end()) return std::nullopt;
      return here[static_cast<std::size_t>(found - of_joint.begin())];
    }
  };

  /// What a joint's model knows of groups of unknowns none of which is held.
  void TakeGroups(const Model& model, const Places& own) {
    for (const GroupPrior& of_joint : model.groups) {
      GroupPrior here{{}, of_joint.precision};
      for (const Index place : of_joint.places) {
        if (const auto found = own.Find(place)) here.places.push_back(*found);
      }
      if (here.places.size() == of_joint.places.size()) all_.groups.push_back(std::move(here));
    }
  }

  static const Unknown& RowOf(const JointFit& fit, Index i) {
    return fit.model.table[static_cast<std::size_t>(i)];
  }

  /// The unknowns of joint j's model.
  VectorXd Of(std::size_t j, const VectorXd& x) const {
    VectorXd of_joint = fits_[j].solved.x;
    of_joint(places_[j].of_joint) = x(places_[j].here);
    return of_joint;
  }

  JointSays Says(std::size_t j, const VectorXd& x) const {
    const ModelSamples& samples = columns_[j].samples;
    const Selection used{samples.keep, {}};
    const ModelRows rows = ModelAt(fits_[j].model, Of(j, x)).All();
    const double scale = std::sqrt(fits_[j].solved.noise.scale());
    return {Kept(rows.derivatives, used)(Eigen::all, places_[j].of_joint) / scale,
            Kept(VectorXd(samples.torque - rows.force), used) / scale};
  }

  /// The rows of the priors: of each joint's own unknowns and, once, of z. The priors of log gains are about their mean.
  RowSums OfPriors(const VectorXd& x) const {
    const double n = std::max(static_cast<double>(gains_.size()), 1.0);
    MatrixXd rows = MatrixXd::Identity(x.size(), x.size());
    rows(gains_, gains_).array() -= 1 / n;
    VectorXd off = x - all_.PriorMean();
    off(gains_) = x(gains_).array() - x(gains_).sum() / n;
    const MatrixXd precision = all_.PriorPrecision(), weighed = precision * rows;
    return {rows.transpose() * weighed, -weighed.transpose() * off, off.dot(precision * off)};
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
  Model all_;  // the table of x alone
  Slice z_;
  std::vector<Index> gains_;    // places of the log gains in x
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

#include "identification/nonlinear/lugre_answer.h"

#include <algorithm>
#include <cmath>

#include "identification/linear/least_squares.h"
#include "identification/nonlinear/lugre_data.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

constexpr double kOutlier = 4;  // standard deviations

/// Rms of residuals, those beyond kOutlier robust standard deviations left out. [n]
double RobustRms(std::vector<double> residuals) {
  if (residuals.empty()) return 0;
  // robust standard deviation, by the median size
  Eigen::VectorXd sizes = Eigen::Map<const Eigen::ArrayXd>(
                              residuals.data(), static_cast<Eigen::Index>(residuals.size()))
                              .abs();
  const double most = kOutlier * MedianInPlace(sizes) / 0.6745;
  // root mean square of the others
  double squares = 0, count = 0;
  for (const double residual : residuals) {
    if (std::abs(residual) > most) continue;
    squares += residual * residual;
    count += 1;
  }
  return std::sqrt(squares / std::max(count, 1.0));
}

/// The columns of the Jacobian that belong to parameters which are not constant.
Eigen::MatrixXd FreeColumns(const LugreProblem& problem, const Eigen::MatrixXd& jacobian) {
  Eigen::MatrixXd free(jacobian.rows(),
                       problem.size() - static_cast<Eigen::Index>(problem.constant.size()));
  Eigen::Index column = 0;
  for (Eigen::Index i = 0; i < problem.size(); ++i) {
    if (!problem.IsConstant(i)) free.col(column++) = jacobian.col(i);
  }
  return free;
}

/// By how much the sampling shifts the parameters: linear motion between samples errs with the
/// square of the interval, so that the error is a third of what leaving out every other sample
/// changes (Richardson). jacobian: [n x d] of the free parameters, over the deviations.
Eigen::VectorXd SamplingShift(const IdentifierInput& input, const LugreProblem& problem,
                              const LugreFit& fit, const Eigen::MatrixXd& jacobian) {
  const HalvedProblem halved = Halve(input, problem);
  const Eigen::VectorXd full = LugreTorque(problem, fit.solution, fit.loads);
  const Eigen::VectorXd half = LugreTorque(halved.problem, fit.solution, fit.loads);
  // rows of the samples in the Jacobian
  std::vector<Eigen::Index> row(static_cast<size_t>(full.size()), -1);
  Eigen::Index rows = 0;
  for (Eigen::Index i = 0; i < full.size(); ++i) {
    if (problem.used.keep[i]) row[static_cast<size_t>(i)] = rows++;
  }

  const Eigen::Index n = halved.problem.used.count();
  Eigen::MatrixXd J(n, jacobian.cols());
  // shift of the torque in deviations, where both grids use the sample
  Eigen::VectorXd error(n);
  Eigen::Index k = 0;
  for (size_t j = 0; j < halved.samples.size(); ++j) {
    const Eigen::Index i = halved.samples[j], r = row[static_cast<size_t>(i)];
    if (r < 0) continue;
    J.row(k) = jacobian.row(r);
    error[k++] = (half[static_cast<Eigen::Index>(j)] - full[i]) / (3 * problem.deviation[r]);
  }
  // the shift of the parameters, by least squares
  return Cofactor(J.transpose() * J) * (J.transpose() * error);
}

}  // namespace

NoiseOfGroups WeighLugre(const Selection& selection, const LugreFit& fit, LugreProblem& problem) {
  // residuals at constant speed, and others
  const Eigen::VectorXd residual = fit.residual.cwiseProduct(problem.deviation);
  std::vector<double> kept, others;
  Eigen::Index row = 0;
  for (Eigen::Index i = 0; i < problem.used.keep.size(); ++i) {
    if (problem.used.keep[i]) (selection.keep[i] ? kept : others).push_back(residual[row++]);
  }
  NoiseOfGroups noise;
  noise.kept = RobustRms(kept);
  // a handful of samples tells no noise
  const bool few = static_cast<Eigen::Index>(others.size()) < 3 * problem.size();
  noise.others = few ? noise.kept : RobustRms(others);
  // each sample has the noise of its group, an outlier a larger one
  const double least = 1e-12 * problem.torque.cwiseAbs().maxCoeff();
  row = 0;
  for (Eigen::Index i = 0; i < problem.used.keep.size(); ++i) {
    if (!problem.used.keep[i]) continue;
    const double deviation = std::max(selection.keep[i] ? noise.kept : noise.others, least);
    problem.deviation[row] = std::max(deviation, std::abs(residual[row]) / kOutlier);
    if (std::abs(residual[row]) <= kOutlier * deviation) problem.deviation[row] = deviation;
    ++row;
  }
  return noise;
}

LugreAnswer JudgeLugre(const IdentifierInput& input, const LugreProblem& problem, LugreFit fit) {
  LugreAnswer answer;
  // a parameter that is held has no row among the errors
  for (Eigen::Index i = 0, row = 0; i < problem.size(); ++i) {
    answer.rows.push_back(problem.IsConstant(i) ? -1 : row++);
  }
  const Eigen::MatrixXd jacobian = FreeColumns(problem, fit.jacobian);
  answer.known = EstimateCovariance(jacobian, Cofactor(jacobian.transpose() * jacobian),
                                    fit.residual, problem.used);
  // the sampling's error beside that of the noise
  const Eigen::VectorXd shift = SamplingShift(input, problem, fit, jacobian);

  answer.known.covariance += shift * shift.transpose();
  answer.fit = std::move(fit);
  return answer;
}

}  // namespace warmjoint

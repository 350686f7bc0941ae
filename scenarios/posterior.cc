#include "scenarios/posterior.h"

#include <warmjoint/parameter_covariance.h>

#include <Eigen/Eigenvalues>

#include "models/foundation/excerpt.h"
#include "models/foundation/serialize.h"
#include "models/friction/friction_json.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Draws outside of the physical bounds in a row after which an estimate counts as beyond them.
constexpr int kMostDraws = 1000;

/// Where the parameter stands in a friction; nothing where it has none of that name.
double* Find(Friction& friction, const std::string& name) {
  if (const auto found = friction.parameters.find(name); found != friction.parameters.end()) {
    return &found->second;
  }
  if (!friction.thermal) return nullptr;
  if (name == "thermal_gain") return &friction.thermal->gain;
  if (name == "thermal_time_constant") return &friction.thermal->time_constant;
  return nullptr;
}

/// The symmetric root; rounding in a singular covariance is taken for zero.
MatrixXd RootOf(const MatrixXd& covariance) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(covariance);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

/// Units differ by many orders, so that the test is made on correlations.
void CheckCovariance(const MatrixXd& covariance, const Place& place) {
  const auto wrong = [&](const char* what) {
    Refuse(place, "covariance {}; take it from estimate.json as it is", what);
  };
  constexpr double rounding = 1e-9;
  // finite, symmetric, and without a negative variance in any direction
  if (!covariance.allFinite()) wrong("holds numbers that are not finite");
  if (!(covariance.diagonal().array() >= 0).all()) wrong("has a negative variance");
  const Eigen::VectorXd scale =
      covariance.diagonal().cwiseSqrt().unaryExpr([](double s) { return s > 0 ? 1 / s : 1; });
  const MatrixXd correlation = scale.asDiagonal() * covariance * scale.asDiagonal();
  if (!correlation.isApprox(correlation.transpose(), rounding)) wrong("is not symmetric");
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(correlation, Eigen::EigenvaluesOnly);
  if (covariance.size() > 0 && solver.eigenvalues()[0] < -rounding) {
    wrong("has a negative variance in some direction");
  }
}

}  // namespace

Posterior PosteriorFrom(const Node& node, const Friction& friction) {
  const auto posterior = ReadAs<Posterior>(node);
  // names of the friction's own parameters, and a covariance that is one
  Friction known = friction;
  for (const std::string& name : posterior.parameters) {
    if (!Find(known, name)) {
      Refuse(node.place(), "the friction has no parameter '{}'", Excerpt(name));
    }
  }
  CheckCovariance(posterior.covariance, node.place());
  return posterior;
}

Posterior PosteriorOfEstimate(const Node& estimate, const Friction& friction) {
  const auto node = estimate.Find("covariance");
  if (!node) {
    Refuse(estimate.place(),
           "the estimate has no covariance to draw from: it was refused, or its identifier "
           "gives no intervals. Leave `draw` out to take its numbers as they are");
  }
  // the matrix of all that was estimated
  const auto covariance = ReadAs<ParameterCovariance>(*node);
  const std::vector<std::string>& names = covariance.parameters;
  const MatrixXd& whole = covariance.matrix;

  // rows and columns of what the friction has
  Posterior posterior;
  Friction known = friction;
  std::vector<Index> kept;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!Find(known, names[i])) continue;
    posterior.parameters.push_back(names[i]);
    kept.push_back(static_cast<Index>(i));
  }
  if (kept.empty()) {
    Refuse(estimate.place(),
           "the estimate's covariance holds no parameter of its friction; leave `draw` out to take "
           "its numbers as they are");
  }
  posterior.covariance = whole(kept, kept);
  CheckCovariance(posterior.covariance, estimate.place());
  return posterior;
}

Friction Draw(const Posterior& posterior, const Friction& friction, RandomStream& random,
              const Place& place) {
  const MatrixXd root = RootOf(posterior.covariance);
  for (int i = 0; i < kMostDraws; ++i) {
    // one draw of the normal distribution around the estimate
    Eigen::VectorXd normal(root.cols());
    for (double& value : normal) value = random.Normal();
    const Eigen::VectorXd moves = root * normal;
    Friction drawn = friction;
    for (std::size_t k = 0; k < posterior.parameters.size(); ++k) {
      *Find(drawn, posterior.parameters[k]) += moves[static_cast<Index>(k)];
    }
    try {
      CheckFriction(drawn, place);
      return drawn;
    } catch (const BadInput&) {
      // outside of the bounds
    }
  }
  Refuse(place,
         "of {} frictions drawn from its posterior none is within the physical bounds of its "
         "parameters; the estimate is too uncertain to draw from",
         kMostDraws);
}

}  // namespace warmjoint

#include "identification/adequacy/growing_fit.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "identification/adequacy/significance.h"
#include "identification/linear/fit_gravity.h"

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// what is left of a feature of norm 1 beside the fit, below which it counts as part of the fit
constexpr double kDistinct = 0.02;
constexpr double kFewestFree = 8;  // parts, or samples, beyond the columns of a fit

Basis Orthonormal(const MatrixXd& columns, double distinct) {
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(columns);
  const Index most = std::min(columns.rows(), columns.cols());
  const Index rank = (qr.matrixQR().diagonal().head(most).array().abs() > distinct).count();
  Basis result;
  result.basis = qr.householderQ() * MatrixXd::Identity(columns.rows(), rank);
  MatrixXd inverse = MatrixXd::Zero(columns.cols(), rank);
  inverse.topRows(rank) = qr.matrixQR()
                              .topLeftCorner(rank, rank)
                              .triangularView<Eigen::Upper>()
                              .solve(MatrixXd::Identity(rank, rank));
  result.mix = qr.colsPermutation() * inverse;
  return result;
}

/// The part of the recording that each row belongs to; about as many samples in each. [m]
Eigen::VectorXi PartOf(const VectorXd& weight, Index parts) {
  Eigen::VectorXi part(weight.size());
  const double total = weight.sum();
  double before = 0;
  for (Index i = 0; i < weight.size(); ++i) {
    part[i] = static_cast<int>((before + 0.5 * weight[i]) / total * static_cast<double>(parts));
    before += weight[i];
  }
  return part;
}

/// How many parts carry features: all of them where each carries as much, one where that one
/// carries all. part: [m]; own: [m x q] orthonormal
double CarryingParts(const MatrixXd& own, const Eigen::VectorXi& part) {
  VectorXd share = VectorXd::Zero(part[part.size() - 1] + 1);
  for (Index i = 0; i < part.size(); ++i) share[part[i]] += own.row(i).squaredNorm();
  return share.sum() * share.sum() / share.squaredNorm();
}

/// By how the scores of the rest scatter from part to part; no evidence where the parts that carry
/// the features are too few. part: [m]; p: columns of the fit
BlockEvidence ByParts(const VectorXd& coefficients, const MatrixXd& own, Index p,
                      const VectorXd& rest, const Eigen::VectorXi& part) {
  const Index q = own.cols();
  const double parts = CarryingParts(own, part);
  const double freedom = parts - static_cast<double>(p + q);
  if (freedom < kFewestFree) return {MatrixXd::Zero(q, q), 0};
  MatrixXd scores = MatrixXd::Zero(q, part[part.size() - 1] + 1);
  for (Index i = 0; i < rest.size(); ++i) {
    scores.col(part[i]) += rest[i] * own.row(i).transpose();
  }
  const MatrixXd scatter = parts / freedom * scores * scores.transpose();
  return {scatter, HotellingDeviations(coefficients, scatter, parts)};
}

/// Deviations from which a block counts as found. most: whether it explains half of what is left.
double Certain(const Block& block, bool most) {
  if (block.on == Dependence::initial_energy) return kCertainStart;
  if (block.features.cols() == 1) return kCertainNamed;
  return most ? kCertainMost : kCertain;
}

}  // namespace

GrowingFit::GrowingFit(const VectorXd& weight, const VectorXd& residual,
                       const MatrixXd& derivatives, const Selection& place,
                       const std::vector<Block>& candidates)
    : place_(place),
      part_(PartOf(weight, std::min(kParts, weight.size() / 2))),
      roots_(weight.cwiseSqrt()),
      norms_((roots_.asDiagonal() * derivatives).colwise().norm().cwiseMax(1e-300)),
      columns_(Normed(derivatives)),
      residual_(roots_.cwiseProduct(residual)) {
  LearnNoise(candidates);
  Refit();
}

void GrowingFit::LearnNoise(const std::vector<Block>& candidates) {
  MatrixXd all = columns_;
  for (const Block& block : candidates) all = Beside(all, Normed(block.features));
  const MatrixXd basis = Orthonormal(all, kDistinct).basis;
  noise_ = FitNoise(residual_ - basis * (basis.transpose() * residual_), place_);

  // what all of them took up counts in samples, at most half of them
  const auto m = static_cast<double>(residual_.size());
  const double taken =
      std::min(ScatterThrough(noise_, basis, place_).trace() / noise_.variance, 0.5 * m);
  noise_.variance *= m / (m - taken);
  noise_.innovation *= m / (m - taken);
  taken_ = static_cast<double>(basis.cols());
}

BlockEvidence GrowingFit::ByColour(const VectorXd& coefficients, const MatrixXd& own) const {
  const MatrixXd scatter = ScatterThrough(noise_, own, place_);
  const double red = scatter.selfadjointView<Eigen::Lower>().operatorNorm() / noise_.variance;
  const double samples = static_cast<double>(own.rows()) / std::max(2 * red - 1, 1.0) - taken_;
  const double fewest = kFewestFree + static_cast<double>(own.cols());
  return {scatter, HotellingDeviations(coefficients, scatter, std::max(samples, fewest))};
}

std::optional<Structure> GrowingFit::Test(const Block& block) const {
  if (block.features.cols() == 0) return std::nullopt;
  MatrixXd features = Normed(block.features);
  const MatrixXd shared = fit_.basis.transpose() * features;
  features -= fit_.basis * shared;
  const Basis own = Orthonormal(features, kDistinct);
  if (own.basis.cols() == 0) return std::nullopt;

  const VectorXd b = own.basis.transpose() * left_;
  const VectorXd rest = left_ - own.basis * b;
  BlockEvidence evidence = ByColour(b, own.basis);
  const bool start = block.on == Dependence::initial_energy;
  if (!start) {
    BlockEvidence parts = ByParts(b, own.basis, columns_.cols(), rest, part_);
    if (parts.deviations > evidence.deviations) evidence = std::move(parts);
  }
  Structure structure;
  structure.on = block.on;
  structure.explained = b.squaredNorm() - evidence.scatter.trace();
  structure.merit = b.squaredNorm() - static_cast<double>(b.size()) *
                                          std::log(static_cast<double>(rest.size())) *
                                          noise_.variance;
  structure.deviations = evidence.deviations;
  const bool most = structure.explained > 0.5 * left_.squaredNorm();
  if (evidence.deviations < Certain(block, most) || structure.explained <= 0) return std::nullopt;

  // the parameters give way: basis = features mix, whose share within the fit is `shared`
  const Index p = norms_.size();
  const MatrixXd give = -(fit_.mix * shared * own.mix).topRows(p);
  structure.moves = (give * b).cwiseQuotient(norms_.transpose());
  structure.move_deviations = (give * evidence.scatter * give.transpose())
                                  .diagonal()
                                  .cwiseMax(0)
                                  .cwiseSqrt()
                                  .cwiseQuotient(norms_.transpose());
  return structure;
}

void GrowingFit::Take(const Block& block) {
  columns_ = Beside(columns_, Normed(block.features));
  Refit();
}

/// Weighted columns of norm 1; a column of zeros stays one.
MatrixXd GrowingFit::Normed(const MatrixXd& columns) const {
  MatrixXd normed = roots_.asDiagonal() * columns;
  for (Index i = 0; i < normed.cols(); ++i) {
    const double norm = normed.col(i).norm();
    if (norm > 0) normed.col(i) /= norm;
  }
  return normed;
}

void GrowingFit::Refit() {
  fit_ = Orthonormal(columns_, 1e-9);
  left_ = residual_ - fit_.basis * (fit_.basis.transpose() * residual_);
}

}  // namespace warmjoint::inline identification

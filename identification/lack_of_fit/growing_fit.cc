#include "identification/lack_of_fit/growing_fit.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "identification/lack_of_fit/orthonormal.h"
#include "identification/lack_of_fit/significance.h"
#include "identification/linear/rigid_part.h"

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// what is left of a feature of norm 1 beside the fit, below which it counts as part of the fit; why: with 0.013 and 0.03
// no verdict changes in 50 logs of tests/studies/sensitivity/energy-ml.yaml, and one interval is wider with 0.03
constexpr double kDistinct = 0.02;
constexpr double kWorthACloserLook = 0.05;  // p that no correction makes a rejection
constexpr double kFewestFree = 8;           // parts, or samples, beyond the columns of a fit

/// The part of the recording that each row belongs to; about as many samples in each. [m]
Eigen::VectorXi PartOf(const VectorXd& weight, Index parts) {
  Eigen::VectorXi part(weight.size());
  const double total = weight.sum();
  double before = 0;
  for (Index i = 0; i < weight.size(); ++i) {
    // the middle of a row says where it belongs
    part[i] = static_cast<int>((before + 0.5 * weight[i]) / total * static_cast<double>(parts));
    before += weight[i];
  }
  return part;
}

/// A scatter whose variance along every direction is `least` or more. [q x q]
MatrixXd NoQuieter(const MatrixXd& scatter, double least) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> along(scatter);
  return along.eigenvectors() * along.eigenvalues().cwiseMax(least).asDiagonal() *
         along.eigenvectors().transpose();
}

/// How many parts carry features: all of them where each carries as much, one where that one
/// carries all. part: [m]; own: [m x q] orthonormal
double CarryingParts(const MatrixXd& own, const Eigen::VectorXi& part) {
  VectorXd share = VectorXd::Zero(part[part.size() - 1] + 1);
  for (Index i = 0; i < part.size(); ++i) share[part[i]] += own.row(i).squaredNorm();
  return share.sum() * share.sum() / share.squaredNorm();
}

}  // namespace

GrowingFit::GrowingFit(const VectorXd& weight, const VectorXd& residual,
                       const MatrixXd& derivatives, const Selection& place)
    : place_(place),
      part_(PartOf(weight, std::min(kParts, weight.size() / 2))),
      roots_(weight.cwiseSqrt()),
      norms_((roots_.asDiagonal() * derivatives).colwise().norm().cwiseMax(1e-300)),
      columns_(Normed(derivatives)),
      residual_(roots_.cwiseProduct(residual)) {
  Refit();
}

void GrowingFit::LearnNoise(const std::vector<Features>& all) {
  // what remains beside the fit and all features together is noise
  MatrixXd columns = columns_;
  for (const Features& features : all) columns = Beside(columns, Normed(features.columns));
  const MatrixXd mix = MixOfDistinct(columns, kDistinct);
  const VectorXd shared = mix.transpose() * (columns.transpose() * residual_);
  noise_ = FitNoise(residual_ - columns * (mix * shared), place_);

  // what all of them took up counts in samples, at most half of them
  const auto m = static_cast<double>(size());
  taken_ = static_cast<double>(mix.cols());
  const double all_taken =
      noise_.order() == 0 ? taken_
                          : ScatterThrough(noise_, columns * mix, place_).trace() / noise_.variance;
  const double taken = std::min(all_taken, 0.5 * m);
  noise_.variance *= m / (m - taken);
  noise_.innovation *= m / (m - taken);
}

GrowingFit::Evidence GrowingFit::ByColour(const VectorXd& coefficients, const MatrixXd& own) const {
  // white noise scatters alike along all directions
  const MatrixXd scatter =
      noise_.order() == 0 ? MatrixXd(noise_.variance * MatrixXd::Identity(own.cols(), own.cols()))
                          : ScatterThrough(noise_, own, place_);
  const auto rows = static_cast<double>(own.rows());

  // the coefficient a of AR(1) noise is estimated too small by (1 + 3 a)/m (Marriott, Pope 1954),
  // and with it R by a share of (4 R - 2)/m
  const double seen = scatter.selfadjointView<Eigen::Lower>().operatorNorm() / noise_.variance;
  const double small = 1 + std::max(4 * seen * (1 + 4 * seen / rows) - 2, 0.0) / rows;
  // a fit that takes up what is slow leaves a rest that looks too fast: along no direction of the
  // features is noise quieter than white
  const MatrixXd unbiased = NoQuieter(small * scatter, noise_.variance);
  // how many samples tell the noise, were it AR(1) noise as strong along the features
  const double red = std::max(small * seen, 1.0);
  const double samples = rows / std::max(2 * red - 1, 1.0) - taken_;
  const double fewest = kFewestFree + static_cast<double>(own.cols());
  return {unbiased, HotellingPValue(coefficients, unbiased, std::max(samples, fewest))};
}

/// By how the scores of the rest scatter from part to part; no evidence where the parts that carry
/// the features are too few. own: [m x q] orthonormal
GrowingFit::Evidence GrowingFit::ByParts(const VectorXd& coefficients, const MatrixXd& own,
                                         const VectorXd& rest) const {
  const Index q = own.cols();
  // the parts that carry the features have to outnumber the columns clearly
  const double parts = CarryingParts(own, part_);
  const double freedom = parts - static_cast<double>(columns_.cols() + q);
  if (freedom < kFewestFree) return {MatrixXd::Zero(q, q), 1};

  // the score of each part: they scatter as much as the noise makes them
  MatrixXd scores = MatrixXd::Zero(q, part_[part_.size() - 1] + 1);
  for (Index i = 0; i < rest.size(); ++i) {
    scores.col(part_[i]) += rest[i] * own.row(i).transpose();
  }
  MatrixXd scatter = parts / freedom * scores * scores.transpose();
  const double p = HotellingPValue(coefficients, scatter, parts);
  if (noise_.order() == 0 || p > kWorthACloserLook) return {scatter, p};

  // what the noise of neighbouring parts has in common is not in their scatter
  scatter *= AcrossParts(own);
  return {scatter, HotellingPValue(coefficients, scatter, parts)};
}

double GrowingFit::AcrossParts(const MatrixXd& own) const {
  // the scatter of each part by itself, against that of all together
  double within = 0;
  for (int k = 0; k <= part_[part_.size() - 1]; ++k) {
    const VectorXd inside = (part_.array() == k).cast<double>().matrix();
    within += ScatterThrough(noise_, inside.asDiagonal() * own, place_).trace();
  }
  return std::max(1.0, ScatterThrough(noise_, own, place_).trace() / within);
}

Finding GrowingFit::Test(const Features& features) const {
  Finding finding;
  finding.period = features.period;
  if (features.columns.cols() == 0) return finding;

  // what of the features lies beside the fit
  MatrixXd beside = Normed(features.columns);
  const MatrixXd shared = fit_.basis.transpose() * beside;
  beside -= fit_.basis * shared;
  const Basis own = Orthonormal(beside, kDistinct);
  if (own.basis.cols() == 0) return finding;

  // how likely noise alone does that
  const VectorXd b = own.basis.transpose() * left_;
  const VectorXd rest = left_ - own.basis * b;
  Evidence evidence = ByColour(b, own.basis);
  if (Evidence parts = ByParts(b, own.basis, rest); parts.p < evidence.p) {
    evidence = std::move(parts);
  }

  // the smaller of two probabilities counts twice, and once for each candidate
  finding.made = true;
  finding.p = std::min(1.0, 2 * evidence.p * features.candidates);
  // noise alone explains a part of it: that is taken off
  finding.explained = std::max(0.0, b.squaredNorm() - evidence.scatter.trace());
  finding.gain = b.squaredNorm() - static_cast<double>(b.size()) *
                                       std::log(static_cast<double>(rest.size())) * noise_.variance;

  // the parameters give way: basis = features mix, whose share within the fit is `shared`
  const Index p = norms_.size();
  const MatrixXd give = -(fit_.mix * shared * own.mix).topRows(p);
  finding.moves = (give * b).cwiseQuotient(norms_.transpose());
  finding.move_deviations = (give * evidence.scatter * give.transpose())
                                .diagonal()
                                .cwiseMax(0)
                                .cwiseSqrt()
                                .cwiseQuotient(norms_.transpose());
  return finding;
}

void GrowingFit::Take(const Features& features) {
  columns_ = Beside(columns_, Normed(features.columns));
  Refit();
}

VectorXd GrowingFit::ExplainedBy(const MatrixXd& columns) const {
  // what the fit holds of each column, and its product with what the fit leaves, which none of that has
  const MatrixXd weighted = roots_.asDiagonal() * columns;
  const MatrixXd shared = fit_.basis.transpose() * weighted;
  const VectorXd products = weighted.transpose() * left_;
  VectorXd explained = VectorXd::Zero(columns.cols());
  for (Index i = 0; i < columns.cols(); ++i) {
    const double square = weighted.col(i).squaredNorm();
    const double beside = square - shared.col(i).squaredNorm();
    if (beside > kDistinct * kDistinct * square) explained[i] = products[i] * products[i] / beside;
  }
  return explained;
}

double GrowingFit::CoefficientOf(const VectorXd& column) const {
  const VectorXd weighted = roots_.cwiseProduct(column);
  const VectorXd beside = weighted - fit_.basis * (fit_.basis.transpose() * weighted);
  const double square = beside.squaredNorm();
  const bool distinct = square > kDistinct * kDistinct * weighted.squaredNorm();
  return distinct ? beside.dot(left_) / square : 0;
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

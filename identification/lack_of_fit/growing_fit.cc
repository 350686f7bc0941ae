#include "identification/lack_of_fit/growing_fit.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "identification/lack_of_fit/orthonormal.h"
#include "identification/lack_of_fit/significance.h"
#include "identification/linear/rigid_part.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// what is left of a feature of norm 1 beside the fit, below which it counts as part of the fit; why: with 0.013 and 0.03
// no verdict changes in 50 logs of tests/studies/sensitivity/energy-ml.yaml, and one interval is wider with 0.03
constexpr double kDistinct = 0.02;
// of a derivative of norm 1 beside the others; why: far above what rounding leaves of one that is a mix of them, 1e-13,
// and far below what a log tells apart
constexpr double kApart = 1e-9;
constexpr double kNoNorm = 1e-300;          // of a column of zeros
constexpr double kWorthACloserLook = 0.05;  // p that no correction makes a rejection
constexpr double kFewestFree = 8;           // parts, or samples, beyond the columns of a fit

/// One past the last row of each part of the recording, with about as many samples in each. [parts]
std::vector<Index> EndsOf(const VectorXd& weight, Index parts) {
  std::vector<Index> ends(static_cast<size_t>(parts), 0);
  const double total = weight.sum();
  double before = 0;
  for (Index i = 0; i < weight.size(); ++i) {
    // the middle of a row says where it belongs
    const double middle = (before + 0.5 * weight[i]) / total * static_cast<double>(parts);
    ends[static_cast<size_t>(middle)] = i + 1;
    before += weight[i];
  }
  // a part may have no row
  for (size_t k = 1; k < ends.size(); ++k) ends[k] = std::max(ends[k], ends[k - 1]);
  return ends;
}

/// A scatter whose variance along every direction is `least` or more. [q x q]
MatrixXd NoQuieter(const MatrixXd& scatter, double least) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> along(scatter);
  return along.eigenvectors() * along.eigenvalues().cwiseMax(least).asDiagonal() *
         along.eigenvectors().transpose();
}

/// S of a scatter S S^T. [q x q]
MatrixXd RootOf(const MatrixXd& scatter) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> along(scatter);
  return along.eigenvectors() * along.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

/// How many parts carry features: all of them where each carries as much, one where that one
/// carries all. shares: [parts] squares of the features
double CarryingParts(const VectorXd& shares) {
  return shares.sum() * shares.sum() / shares.squaredNorm();
}

/// Squares of a residual that columns explain beside a fit that leaves nothing of its own in it; 0
/// for a column that it holds. squares: of the columns; held: of what the fit has of them;
/// products: with the residual; all [c].
VectorXd ExplainedBeside(const Eigen::ArrayXd& squares, const Eigen::ArrayXd& held,
                         const Eigen::ArrayXd& products) {
  const Eigen::ArrayXd beside = squares - held;
  return (beside > kDistinct * kDistinct * squares).select(products.square() / beside, 0);
}

}  // namespace

WeighedFit::WeighedFit(const VectorXd& samples, const MatrixXd& derivatives)
    : weight(samples),
      root(weight.cwiseSqrt()),
      norms(Weighed(derivatives).colwise().norm().cwiseMax(kNoNorm)),
      columns(Normed(derivatives)),
      qr(Orthonormal(columns, kApart)) {}

MatrixXd WeighedFit::Normed(const MatrixXd& some) const {
  MatrixXd weighed = Weighed(some);
  for (Index j = 0; j < weighed.cols(); ++j) {
    weighed.col(j) *= 1 / std::max(weighed.col(j).norm(), kNoNorm);
  }
  return weighed;
}

MatrixXd WeighedFit::TakeOff(Eigen::Ref<MatrixXd> weighed) const {
  const MatrixXd shared = qr.basis.transpose() * weighed;
  weighed.noalias() -= qr.basis * shared;
  return shared;
}

MatrixXd WeighedFit::BiasBy(const MatrixXd& forces) const {
  const MatrixXd mix = norms.cwiseInverse().asDiagonal() * qr.r_inverse;
  const MatrixXd shared = qr.basis.transpose() * Weighed(forces);
  return -mix * shared;
}

VectorXd WeighedFit::MostMoves() const {
  const MatrixXd of_rows = qr.r_inverse * (root.asDiagonal() * qr.basis).transpose();
  return of_rows.cwiseAbs().rowwise().sum().cwiseQuotient(norms);
}

GrowingFit::GrowingFit(WeighedFit fit, const VectorXd& residual, const Selection& place)
    : place_(place),
      ends_(EndsOf(fit.weight, std::min(kParts, residual.size() / 2))),
      fit_(std::move(fit)),
      residual_(fit_.root.cwiseProduct(residual)) {
  Refit();
}

void GrowingFit::LearnNoise(const std::vector<Features>& all) {
  // the fit's columns and all features
  Index count = fit_.columns.cols();
  for (const Features& one : all) count += one.columns.cols();
  MatrixXd columns(size(), count);
  columns.leftCols(fit_.columns.cols()) = fit_.columns;
  count = fit_.columns.cols();
  for (const Features& one : all) {
    columns.middleCols(count, one.columns.cols()) = fit_.Normed(one.columns);
    count += one.columns.cols();
  }

  // what remains beside them all together is noise
  const MatrixXd basis = Orthonormal(std::move(columns), kDistinct).basis;
  noise_ = FitNoise(residual_ - basis * (basis.transpose() * residual_), place_);

  // what all of them took up counts in samples, at most half of them
  const auto m = static_cast<double>(size());
  taken_ = static_cast<double>(basis.cols());
  const double all_taken = noise_.order() == 0
                               ? taken_
                               : ScatterThrough(noise_, basis, place_).trace() / noise_.variance;
  const double taken = std::min(all_taken, 0.5 * m);
  noise_.variance *= m / (m - taken);
  noise_.innovation *= m / (m - taken);
}

GrowingFit::Evidence GrowingFit::ByColour(const MatrixXd& own, const VectorXd& b) const {
  // white noise scatters alike along all directions
  const bool white = noise_.order() == 0;
  const Index q = own.cols();
  const MatrixXd scatter = white ? MatrixXd(noise_.variance * MatrixXd::Identity(q, q))
                                 : ScatterThrough(noise_, own, place_);
  const auto rows = static_cast<double>(size());

  // the coefficient a of AR(1) noise is estimated too small by (1 + 3 a)/m (Marriott, Pope 1954),
  // and with it R by a share of (4 R - 2)/m
  const double seen =
      white ? 1 : scatter.selfadjointView<Eigen::Lower>().operatorNorm() / noise_.variance;
  const double small = 1 + std::max(4 * seen * (1 + 4 * seen / rows) - 2, 0.0) / rows;
  // a fit that takes up what is slow leaves a rest that looks too fast: along no direction of the
  // features is noise quieter than white
  const MatrixXd unbiased =
      white ? MatrixXd(small * scatter) : NoQuieter(small * scatter, noise_.variance);
  // how many samples tell the noise, were it AR(1) noise as strong along the features
  const double red = std::max(small * seen, 1.0);
  const double samples = rows / std::max(2 * red - 1, 1.0) - taken_;
  const double fewest = kFewestFree + static_cast<double>(q);
  return {unbiased, HotellingPValue(b, unbiased, std::max(samples, fewest))};
}

/// By how the scores of the rest scatter from part to part; no evidence where the parts that carry
/// the features are too few.
GrowingFit::Evidence GrowingFit::ByParts(const MatrixXd& own, const VectorXd& b) const {
  // what each part has of the features, and its products with what is left of the residual
  const Index q = own.cols();
  const VectorXd rest = left_ - own * b;
  VectorXd shares(std::ssize(ends_));
  MatrixXd scores(shares.size(), q);
  Index begin = 0;
  for (Index k = 0; k < shares.size(); ++k) {
    const Index count = ends_[static_cast<size_t>(k)] - begin;
    const auto part = own.middleRows(begin, count);
    shares[k] = part.squaredNorm();
    scores.row(k) = rest.segment(begin, count).transpose() * part;
    begin += count;
  }

  // the parts that carry the features have to outnumber the columns clearly
  const double parts = CarryingParts(shares);
  const double degrees_of_freedom = parts - static_cast<double>(fit_.columns.cols() + q);
  if (degrees_of_freedom < kFewestFree) return {MatrixXd::Zero(q, q), 1};

  // the score of each part: they scatter as much as the noise makes them
  MatrixXd scatter = parts / degrees_of_freedom * scores.transpose() * scores;
  const double p = HotellingPValue(b, scatter, parts);
  if (noise_.order() == 0 || p > kWorthACloserLook) return {scatter, p};

  // what the noise of neighbouring parts has in common is not in their scatter
  scatter *= AcrossParts(own);
  return {scatter, HotellingPValue(b, scatter, parts)};
}

double GrowingFit::AcrossParts(const MatrixXd& own) const {
  // the scatter of each part by itself, against that of all together
  double within = 0;
  Index begin = 0;
  for (const Index end : ends_) {
    MatrixXd inside = MatrixXd::Zero(own.rows(), own.cols());
    inside.middleRows(begin, end - begin) = own.middleRows(begin, end - begin);
    within += ScatterThrough(noise_, inside, place_).trace();
    begin = end;
  }
  return std::max(1.0, ScatterThrough(noise_, own, place_).trace() / within);
}

Finding GrowingFit::Test(const Features& features) const {
  Finding finding;
  finding.period = features.period;
  // what the features have beside the fit
  MatrixXd columns = fit_.Normed(features.columns);
  const MatrixXd shared = fit_.TakeOff(columns);
  const Basis own = Orthonormal(std::move(columns), kDistinct);
  if (own.basis.cols() == 0) return finding;

  // how likely noise alone does that
  const VectorXd b = own.basis.transpose() * left_;
  Evidence evidence = ByColour(own.basis, b);
  if (Evidence parts = ByParts(own.basis, b); parts.p < evidence.p) evidence = std::move(parts);

  // the smaller of two probabilities counts twice, and once for each candidate
  finding.made = true;
  finding.p = std::min(1.0, 2 * evidence.p * features.candidates);
  // noise alone explains a part of it: that is taken off
  finding.explained = std::max(0.0, b.squaredNorm() - evidence.scatter.trace());
  finding.gain = b.squaredNorm() - static_cast<double>(b.size()) *
                                       std::log(static_cast<double>(size())) * noise_.variance;

  // the parameters give way by what the features share with the fit
  const VectorXd& norms = fit_.norms;
  const MatrixXd give = -fit_.qr.r_inverse.topRows(norms.size()) * (shared * own.r_inverse);
  finding.moves = (give * b).cwiseQuotient(norms);
  finding.move_spread = norms.cwiseInverse().asDiagonal() * give * RootOf(evidence.scatter);
  return finding;
}

void GrowingFit::Take(const Features& features) {
  fit_.columns = ConcatColumns(fit_.columns, fit_.Normed(features.columns));
  fit_.qr = Orthonormal(fit_.columns, kApart);
  Refit();
}

VectorXd GrowingFit::ExplainedBy(const MatrixXd& columns) const {
  const MatrixXd weighed = fit_.Weighed(columns);
  const VectorXd squares = weighed.colwise().squaredNorm();
  const VectorXd held = (fit_.qr.basis.transpose() * weighed).colwise().squaredNorm();
  return ExplainedBeside(squares, held, weighed.transpose() * left_);
}

VectorXd GrowingFit::ExplainedBySteps(const std::vector<Index>& part, Index places,
                                      const VectorXd& height) const {
  // squares, products with what is left, and products with the basis of the rows of each part
  const VectorXd weighed = fit_.Weighed(height);
  MatrixXd sums = MatrixXd::Zero(2 + fit_.qr.basis.cols(), places + 1);
  for (Index i = 0; i < size(); ++i) {
    auto of_part = sums.col(part[static_cast<size_t>(i)]);
    of_part[0] += weighed[i] * weighed[i];
    of_part[1] += weighed[i] * left_[i];
    of_part.tail(sums.rows() - 2) += weighed[i] * fit_.qr.basis.row(i).transpose();
  }

  // and of all rows behind each place
  for (Index k = places; k > 1; --k) sums.col(k - 1) += sums.col(k);
  const auto behind = sums.rightCols(places);
  return ExplainedBeside(behind.row(0), behind.bottomRows(sums.rows() - 2).colwise().squaredNorm(),
                         behind.row(1));
}

double GrowingFit::CoefficientOf(const VectorXd& column) const {
  VectorXd beside = fit_.Weighed(column);
  const double all = beside.squaredNorm();
  fit_.TakeOff(beside);
  const double square = beside.squaredNorm();
  return square > kDistinct * kDistinct * all ? beside.dot(left_) / square : 0;
}

void GrowingFit::Refit() {
  left_ = residual_;
  fit_.TakeOff(left_);
}

}  // namespace warmjoint

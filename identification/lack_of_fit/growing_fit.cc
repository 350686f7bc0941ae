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

// what is left of a feature of norm 1 orthogonal to the fit, below which it counts as part of the fit; why: with 0.013 and 0.03
// no verdict changes in 50 logs of tests/studies/sensitivity/energy-ml.yaml, and one interval is wider with 0.03
constexpr double kDistinct = 0.02;
// of a derivative of norm 1 orthogonal to the others; why: far above what rounding leaves of one that is a mix of them, 1e-13,
// and far below what a log can distinguish
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
    // a row belongs to the part in which its middle is
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

/// The effective number of parts that have a share in features: all parts where each has the same share, 1 where one part
/// has all of it. shares: [parts] squares of the features
double CarryingParts(const VectorXd& shares) {
  return shares.sum() * shares.sum() / shares.squaredNorm();
}

/// Squares of a residual, orthogonal to the fit, that columns explain in addition to the fit; 0
/// for a column that the fit holds. squares: of the columns; held: of what the fit has of them;
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

  // what remains orthogonal to all of them together is noise
  const MatrixXd basis = Orthonormal(std::move(columns), kDistinct).basis;
  noise_ = FitNoise(residual_ - basis * (basis.transpose() * residual_), place_);

  // the squares that all of them took up, as a number of samples, at most half of the samples
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
  // white noise has the same scatter along all directions
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
  // a fit that takes up slow noise leaves a residual that looks too fast, so the noise's variance along any direction of the
  // features is taken to be at least that of white noise
  const MatrixXd unbiased =
      white ? MatrixXd(small * scatter) : NoQuieter(small * scatter, noise_.variance);
  // the number of samples that determine the noise's variance, were it AR(1) noise as strong along the features
  const double red = std::max(small * seen, 1.0);
  const double samples = rows / std::max(2 * red - 1, 1.0) - taken_;
  const double fewest = kFewestFree + static_cast<double>(q);
  return {unbiased, HotellingPValue(b, unbiased, std::max(samples, fewest))};
}

/// The evidence by the scatter of the scores of the residual from part to part; none where too few parts have a share in the features.
GrowingFit::Evidence GrowingFit::ByParts(const MatrixXd& own, const VectorXd& b) const {
  // the share of each part in the features, and its products with what is left of the residual
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

  // there have to be clearly more parts with a share in the features than columns
  const double parts = CarryingParts(shares);
  const double degrees_of_freedom = parts - static_cast<double>(fit_.columns.cols() + q);
  if (degrees_of_freedom < kFewestFree) return {MatrixXd::Zero(q, q), 1};

  // the scores of the parts scatter as much as the noise makes them
  MatrixXd scatter = parts / degrees_of_freedom * scores.transpose() * scores;
  const double p = HotellingPValue(b, scatter, parts);
  if (noise_.order() == 0 || p > kWorthACloserLook) return {scatter, p};

  // the scatter does not show the noise that neighbouring parts have in common
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
  // the part of the features that is orthogonal to the fit
  MatrixXd columns = fit_.Normed(features.columns);
  const MatrixXd shared = fit_.TakeOff(columns);
  const Basis own = Orthonormal(std::move(columns), kDistinct);
  if (own.basis.cols() == 0) return finding;

  // the probability that noise alone explains as much
  const VectorXd b = own.basis.transpose() * left_;
  Evidence evidence = ByColour(own.basis, b);
  if (Evidence parts = ByParts(own.basis, b); parts.p < evidence.p) evidence = std::move(parts);

  // the smaller of two probabilities counts twice, and once for each candidate
  finding.made = true;
  finding.p = std::min(1.0, 2 * evidence.p * features.candidates);
  // the part that noise alone explains is subtracted
  finding.explained = std::max(0.0, b.squaredNorm() - evidence.scatter.trace());
  finding.gain = b.squaredNorm() - static_cast<double>(b.size()) *
                                       std::log(static_cast<double>(size())) * noise_.variance;

  // the parameters change by what the features share with the fit
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

  // and of all rows after each place
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

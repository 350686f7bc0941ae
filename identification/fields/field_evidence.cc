#include "identification/fields/field_evidence.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "identification/model/normal_equations.h"
#include "identification/model/solve.h"
#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStep = 0.04;  // s
// of the noise over a step; why not more: then a level drowns in noise
constexpr std::array kCorrelations{0.0, 0.2, 0.4, 0.5, 0.6, 0.7, 0.8, 0.85, 0.9};
constexpr std::array kCoarse{0.6, 0.8, 0.9, 1.0, 1.1, 1.25, 1.6};
constexpr std::array kFine{0.93, 1.0, 1.07};
constexpr int kAmplitudes = 32;                    // 0, and 31 even in the logarithm
constexpr double kSmallest = 0.003, kLargest = 3;  // shares of the friction
constexpr double kStart = 0.05;    // why: from above, a search rests where fields follow the noise
constexpr double kNothing = 1e-5;  // a share that stands for an amplitude of 0
// probability beforehand that a field is not there; chosen: a real joint has most of what a law lacks
constexpr double kNothingThere = 0.1;
constexpr double kFlat = 1e3;  // spread of flat columns, in deviations of the torque
constexpr int kMostSweeps = 10, kSettle = 6, kDraws = 24;
constexpr double kJitter = 1e-13;

/// The shares that an amplitude may have.
VectorXd Amplitudes() {
  VectorXd all(kAmplitudes);
  all[0] = 0;
  for (int i = 1; i < kAmplitudes; ++i) {
    all[i] = kSmallest * std::pow(kLargest / kSmallest, (i - 1) / (kAmplitudes - 2.0));
  }
  return all;
}

/// What the prior adds to the costs of amplitudes that are even in the logarithm: an amplitude is 0 with kNothingThere, else it has a
/// half-normal density, whose exponent the cost has. scale: of that density. [kAmplitudes]
VectorXd PriorOfAmplitudes(const VectorXd& amplitudes, double scale) {
  const auto some = amplitudes.tail(kAmplitudes - 1).array();
  const double all = (some * (-0.5 * (some / scale).square()).exp()).sum();
  VectorXd cost(kAmplitudes);
  cost[0] = -2 * std::log(kNothingThere / (1 - kNothingThere) * all);
  cost.tail(kAmplitudes - 1) = -2 * some.log();
  return cost;
}

/// H of any scale by its Cholesky factors with a diagonal of 1.
struct Factors {
  explicit Factors(const MatrixXd& h) : scale(h.diagonal().cwiseSqrt().cwiseInverse()) {
    MatrixXd scaled = scale.asDiagonal() * h * scale.asDiagonal();
    scaled.diagonal().array() += kJitter;
    llt.compute(scaled);
  }
  bool stands() const { return llt.info() == Eigen::Success; }
  double LogDeterminant() const {
    return 2 * (llt.matrixLLT().diagonal().array().log().sum() - scale.array().log().sum());
  }
  /// L^-1 D b
  MatrixXd Half(const MatrixXd& b) const { return llt.matrixL().solve(scale.asDiagonal() * b); }
  VectorXd Solve(const VectorXd& b) const {
    return scale.asDiagonal() * llt.solve(scale.asDiagonal() * b);
  }
  MatrixXd Inverse() const {
    const Index n = scale.size();
    return scale.asDiagonal() * llt.solve(MatrixXd::Identity(n, n)) * scale.asDiagonal();
  }

  VectorXd scale;
  Eigen::LLT<MatrixXd> llt;
};

/// Rows [flat, fields, y], of which the fields have few numbers that are not 0.
struct AllRows {
  MatrixXd dense;     // [n x p + 1] flat, y
  SparseRows sparse;  // [n x m] fields

  /// The rows at these places.
  AllRows At(const std::vector<Index>& places) const {
    std::vector<Eigen::Triplet<double>> kept;
    for (Index i = 0; i < std::ssize(places); ++i) {
      for (SparseRows::InnerIterator one(sparse, places[static_cast<size_t>(i)]); one; ++one) {
        kept.emplace_back(i, one.col(), one.value());
      }
    }
    AllRows some{dense(places, Eigen::all), SparseRows(std::ssize(places), sparse.cols())};
    some.sparse.setFromTriplets(kept.begin(), kept.end());
    return some;
  }

  /// A^T B of as many rows of both. [p + m + 1]^2
  static MatrixXd Product(const AllRows& a, const AllRows& b) {
    const Index p = a.dense.cols() - 1, m = a.sparse.cols();
    const MatrixXd both = a.dense.transpose() * b.dense;
    const MatrixXd fields_first = a.sparse.transpose() * b.dense;
    const MatrixXd fields_last = b.sparse.transpose() * a.dense;

    MatrixXd gram(p + m + 1, p + m + 1);
    gram.topLeftCorner(p, p) = both.topLeftCorner(p, p);
    gram.block(0, p + m, p, 1) = both.col(p).head(p);
    gram.block(p + m, 0, 1, p) = both.row(p).head(p);
    gram(p + m, p + m) = both(p, p);
    gram.block(p, 0, m, p) = fields_first.leftCols(p);
    gram.block(p, p + m, m, 1) = fields_first.col(p);
    gram.block(0, p, p, m) = fields_last.leftCols(p).transpose();
    gram.block(p + m, p, 1, m) = fields_last.col(p).transpose();
    gram.block(p, p, m, m) = MatrixXd(SparseRows(a.sparse.transpose()) * b.sparse);
    return gram;
  }
  MatrixXd Gram() const { return Product(*this, *this); }
};

AllRows AllColumns(const FieldRows& rows, const std::vector<FieldBlock>& blocks, Index fields) {
  AllRows all{MatrixXd(rows.size(), rows.flat.cols() + 1), SparseRows(rows.size(), fields)};
  all.dense << rows.flat, rows.torque;
  all.sparse.reserve(
      Eigen::VectorXi::Constant(rows.size(), static_cast<int>(2 * std::ssize(blocks))));
  for (Index n = 0; n < rows.size(); ++n) {
    Index begin = 0;
    for (const FieldBlock& block : blocks) {
      for (SparseRows::InnerIterator i(block.columns, n); i; ++i) {
        all.sparse.insert(n, begin + i.col()) = i.value();
      }
      begin += block.size();
    }
  }
  all.sparse.makeCompressed();
  return all;
}

/// An index drawn with weights exp(-cost/2).
Index Draw(const VectorXd& cost, StartStream& random) {
  const VectorXd weight = (-0.5 * (cost.array() - cost.minCoeff())).exp();
  double left = random.Uniform(0, 1) * weight.sum();
  for (Index i = 0; i < weight.size(); ++i) {
    left -= weight[i];
    if (left < 0) return i;
  }
  return weight.size() - 1;
}

}  // namespace

FieldEvidence::FieldEvidence(const FieldRows& rows, const std::vector<FieldBlock>& blocks,
                             double friction)
    : rows_(rows), blocks_(blocks), friction_(friction), flat_(rows.flat.cols()), size_(flat_) {
  for (const double of_step : kCorrelations) {
    correlations_.push_back(std::pow(of_step, rows.step / kStep));
  }
  for (const FieldBlock& block : blocks) {
    begins_.push_back(size_);
    size_ += block.size();
  }
  const AllRows all = AllColumns(rows, blocks, size_ - flat_);
  std::vector<Index> firsts, lasts, after, before;
  for (Index n = 0; n < rows.size(); ++n) {
    const bool follows = n > 0 && rows.follows[n];
    if (!follows) {
      firsts.push_back(n);
      if (n > 0) lasts.push_back(n - 1);
      continue;
    }
    after.push_back(n);
    before.push_back(n - 1);
  }
  lasts.push_back(rows.size() - 1);
  runs_ = std::ssize(firsts);
  const MatrixXd whole = all.Gram();
  first_ = all.At(firsts).Gram();
  inner_ = whole - first_;
  before_ = whole - all.At(lasts).Gram();
  cross_ = AllRows::Product(all.At(after), all.At(before));
  cross_ = (cross_ + cross_.transpose()).eval();

  // a spread of flat columns by which the data alone decide
  const double spread =
      kFlat * std::sqrt((rows.torque.array() - rows.torque.mean()).square().mean());
  const VectorXd square = rows.flat.colwise().squaredNorm() / static_cast<double>(rows.size());
  const VectorXd least =
      (square.array() / (spread * spread)).max(std::numeric_limits<double>::min());
  flat_precision_ = least.asDiagonal();

  // what is known beforehand, as one more row of each unknown
  flat_product_ = VectorXd::Zero(flat_);
  const Index given = rows.prior_precision.rows();
  flat_precision_.topLeftCorner(given, given) += rows.prior_precision;
  flat_product_.head(given) = rows.prior_precision * rows.prior_mean;

  for (const FieldBlock& block : blocks) {
    auto& roots = roots_.emplace_back();
    auto& inverses = inverses_.emplace_back();
    auto& determinants = log_determinants_.emplace_back();
    for (const MatrixXd& kernel : block.kernels) {
      const Eigen::LLT<MatrixXd> llt(kernel);
      roots.push_back(llt.matrixL());
      inverses.push_back(llt.solve(MatrixXd::Identity(block.size(), block.size())));
      determinants.push_back(2 * llt.matrixLLT().diagonal().array().log().sum());
    }
  }
}

MatrixXd FieldEvidence::GramAt(double rho) const {
  return (1 - rho * rho) * first_ + inner_ + rho * rho * before_ - rho * cross_;
}

VectorXd FieldEvidence::ProductAt(const MatrixXd& gram, double innovation) const {
  VectorXd product = gram.col(size_).head(size_) / innovation;
  product.head(flat_) += flat_product_;
  return product;
}

MatrixXd FieldEvidence::PriorAt(const FieldHyperparameters& at) const {
  MatrixXd prior = MatrixXd::Zero(size_, size_);
  prior.topLeftCorner(flat_, flat_) = flat_precision_;
  for (size_t k = 0; k < blocks_.size(); ++k) {
    const double amplitude = std::max(at.amplitudes[k], kNothing) * friction_;
    prior.block(begins_[k], begins_[k], blocks_[k].size(), blocks_[k].size()) =
        inverses_[k][at.lengths[k]] / (amplitude * amplitude);
  }
  return prior;
}

double FieldEvidence::CostOfNoise(const MatrixXd& gram, const MatrixXd& prior, double correlation,
                                  double innovation) const {
  const Factors factors(gram.topLeftCorner(size_, size_) / innovation + prior);
  if (!factors.stands()) return kInfinity;
  const double explained = factors.Half(ProductAt(gram, innovation)).squaredNorm();
  return static_cast<double>(rows_.size()) * std::log(innovation) -
         static_cast<double>(runs_) * std::log(1 - correlation * correlation) +
         gram(size_, size_) / innovation - explained + factors.LogDeterminant();
}

double FieldEvidence::Cost(const FieldHyperparameters& at) const {
  double cost = CostOfNoise(GramAt(at.correlation), PriorAt(at), at.correlation, at.innovation);
  for (size_t k = 0; k < blocks_.size(); ++k) {
    // log |P| of the field, and the prior of its amplitude
    const double amplitude = std::max(at.amplitudes[k], kNothing) * friction_;
    cost += log_determinants_[k][at.lengths[k]] +
            2 * static_cast<double>(blocks_[k].size()) * std::log(amplitude) +
            std::pow(at.amplitudes[k] / blocks_[k].amplitude_scale, 2);
  }
  return cost;
}

/// A walk over the hyperparameters.
class FieldEvidence::Search {
 public:
  /// What a step does with the costs of its candidates: takes the least, or draws.
  using Choose = std::function<Index(const VectorXd& cost)>;

  Search(const FieldEvidence& of, FieldHyperparameters at)
      : of_(of), at_(std::move(at)), gram_(of.GramAt(at_.correlation)) {}

  const FieldHyperparameters& at() const { return at_; }

  /// Correlation and innovation, on a grid about the present ones.
  template <size_t N>
  void StepNoise(const std::array<double, N>& factors, bool all, const Choose& choose) {
    struct Candidate {
      double correlation, innovation;
    };
    std::vector<Candidate> candidates;
    const std::vector<double>& correlations = of_.correlations_;
    const auto present = std::ranges::find(correlations, at_.correlation) - correlations.begin();
    const double free = 1 - at_.correlation * at_.correlation;
    for (Index i = 0; i < std::ssize(correlations); ++i) {
      if (!all && std::abs(i - present) > 1) continue;
      const double rho = correlations[static_cast<size_t>(i)];
      for (const double factor : factors) {
        candidates.push_back({rho, at_.innovation * factor * (1 - rho * rho) / free});
      }
    }
    const MatrixXd prior = of_.PriorAt(at_);
    VectorXd cost(std::ssize(candidates));
    double of_gram = -1;
    MatrixXd gram;
    for (size_t i = 0; i < candidates.size(); ++i) {
      if (candidates[i].correlation != of_gram) gram = of_.GramAt(candidates[i].correlation);
      of_gram = candidates[i].correlation;
      cost[static_cast<Index>(i)] =
          of_.CostOfNoise(gram, prior, candidates[i].correlation, candidates[i].innovation);
    }
    const Candidate& chosen = candidates[static_cast<size_t>(choose(cost))];
    at_.correlation = chosen.correlation;
    at_.innovation = chosen.innovation;
    gram_ = of_.GramAt(at_.correlation);
  }

  /// Length and amplitude of one field given all else. more: [kAmplitudes] added to the costs of each
  void StepField(size_t k, const VectorXd& more, const Choose& choose) {
    const auto [schur, product] = WithoutOthers(k);
    const FieldBlock& block = of_.blocks_[k];
    VectorXd cost(kAmplitudes * std::ssize(block.lengths));
    for (size_t l = 0; l < block.lengths.size(); ++l) {
      const MatrixXd& root = of_.roots_[k][l];
      const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(root.transpose() * schur * root);
      const Eigen::ArrayXd strength = eigen.eigenvalues().cwiseMax(0);
      const Eigen::ArrayXd pull =
          (eigen.eigenvectors().transpose() * (root.transpose() * product)).array().square();
      for (Index i = 0; i < kAmplitudes; ++i) {
        const double a2 = std::pow(amplitudes_[i] * of_.friction_, 2);
        cost[static_cast<Index>(l) * kAmplitudes + i] =
            (a2 * strength).log1p().sum() - (a2 * pull / (1 + a2 * strength)).sum() +
            std::pow(amplitudes_[i] / block.amplitude_scale, 2) + more[i];
      }
    }
    const Index chosen = choose(cost);
    at_.lengths[k] = static_cast<size_t>(chosen / kAmplitudes);
    at_.amplitudes[k] = amplitudes_[chosen % kAmplitudes];
  }

 private:
  struct Marginal {
    MatrixXd gram;  // [m x m] of a field's columns, without what all other columns explain of them
    VectorXd product;  // [m] with the torque
  };
  Marginal WithoutOthers(size_t k) const {
    const Index size = of_.size_, begin = of_.begins_[k], m = of_.blocks_[k].size();
    MatrixXd h = gram_.topLeftCorner(size, size) / at_.innovation;
    const VectorXd b = of_.ProductAt(gram_, at_.innovation);
    Marginal own{h.block(begin, begin, m, m), b.segment(begin, m)};
    h += of_.PriorAt(at_);
    std::vector<Index> others(static_cast<size_t>(size - m));
    std::iota(others.begin(), others.begin() + begin, 0);
    std::iota(others.begin() + begin, others.end(), begin + m);
    const Factors factors(h(others, others));
    const MatrixXd half = factors.Half(h(others, Eigen::seqN(begin, m)));
    own.gram -= half.transpose() * half;
    own.product -= half.transpose() * factors.Half(b(others));
    return own;
  }

  const FieldEvidence& of_;
  FieldHyperparameters at_;
  MatrixXd gram_;  // at the present correlation
  const VectorXd amplitudes_ = Amplitudes();
};

FieldHyperparameters FieldEvidence::Maximise() const {
  // where a fit without fields leaves the noise
  const VectorXd plain = SolveScaled(GramOf(rows_.flat), rows_.flat.transpose() * rows_.torque);
  const VectorXd left = rows_.torque - rows_.flat * plain;
  double products = 0, squares = 0;
  for (Index n = 1; n < left.size(); ++n) {
    if (!rows_.follows[n]) continue;
    products += left[n] * left[n - 1];
    squares += left[n] * left[n];
  }
  const double rough = squares > 0 ? products / squares : 0;
  FieldHyperparameters start{std::vector<double>(blocks_.size(), kStart), {}};
  for (const FieldBlock& block : blocks_) start.lengths.push_back(block.lengths.size() / 2);
  start.correlation = *std::ranges::min_element(correlations_, {},
                                                [&](double rho) { return std::abs(rho - rough); });
  start.innovation = std::max(left.squaredNorm() / static_cast<double>(left.size()),
                              RoundingVariance(rows_.torque)) *
                     (1 - start.correlation * start.correlation);

  const auto least = [](const VectorXd& cost) {
    Index at = 0;
    cost.minCoeff(&at);
    return at;
  };
  Search search(*this, start);
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    const FieldHyperparameters before = search.at();
    if (sweep < 2) {
      search.StepNoise(kCoarse, true, least);
    } else {
      search.StepNoise(kFine, false, least);
    }
    for (size_t k = 0; k < blocks_.size(); ++k) {
      search.StepField(k, VectorXd::Zero(kAmplitudes), least);
    }
    const FieldHyperparameters& now = search.at();
    if (sweep > 1 && now.amplitudes == before.amplitudes && now.lengths == before.lengths &&
        now.correlation == before.correlation && now.innovation == before.innovation) {
      break;
    }
  }
  return search.at();
}

FieldPosterior FieldEvidence::At(const FieldHyperparameters& at) const {
  const MatrixXd gram = GramAt(at.correlation);
  const Factors factors(gram.topLeftCorner(size_, size_) / at.innovation + PriorAt(at));
  return {factors.Solve(ProductAt(gram, at.innovation)), factors.Inverse()};
}

FieldPosterior FieldEvidence::Averaged(const FieldHyperparameters& start) const {
  const double left = LeftCorrelation(start, At(start).mean);
  std::vector<VectorXd> priors;
  for (const FieldBlock& block : blocks_) {
    priors.push_back(PriorOfAmplitudes(Amplitudes(), block.amplitude_scale));
  }

  StartStream random({});
  const auto draw = [&](const VectorXd& cost) { return Draw(cost, random); };
  Search search(*this, start);
  FieldPosterior sum{VectorXd::Zero(size_), MatrixXd::Zero(size_, size_)};
  MatrixXd means(size_, kDraws);
  for (int sweep = 0; sweep < kSettle + kDraws; ++sweep) {
    search.StepNoise(kFine, false, draw);
    for (size_t k = 0; k < blocks_.size(); ++k) search.StepField(k, priors[k], draw);
    if (sweep < kSettle) continue;
    means.col(sweep - kSettle) = At(search.at()).mean;
    FieldHyperparameters wider = search.at();
    wider.innovation *= left;
    sum.covariance += At(wider).covariance / kDraws;
  }
  sum.mean = means.rowwise().mean();
  const MatrixXd about = means.colwise() - sum.mean;
  sum.covariance += about * about.transpose() / kDraws;
  return sum;
}

double FieldEvidence::LeftCorrelation(const FieldHyperparameters& at, const VectorXd& mean) const {
  VectorXd residual = rows_.torque - rows_.flat * mean.head(flat_);
  for (size_t k = 0; k < blocks_.size(); ++k) {
    residual -= blocks_[k].columns * mean.segment(begins_[k], blocks_[k].size());
  }
  VectorXd white = residual;
  for (Index n = 1; n < white.size(); ++n) {
    if (rows_.follows[n]) white[n] -= at.correlation * residual[n - 1];
  }
  return std::max(NoiseScaleOf(white).correlation, 1.0);
}

double FieldEvidence::EffectiveParameters(const FieldHyperparameters& at) const {
  const MatrixXd gram = GramAt(at.correlation).topLeftCorner(size_, size_) / at.innovation;
  return At(at).covariance.cwiseProduct(gram).sum();
}

}  // namespace warmjoint

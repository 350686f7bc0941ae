#include "identification/adequacy/smooth_structure.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "identification/adequacy/significance.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// what is left of a feature of norm 1 beside the fit, below which it counts as part of the fit
constexpr double kDistinct = 0.02;

struct Block {
  Dependence on;
  MatrixXd features;  // [m x q]
};

std::vector<Block> MakeBlocks(const Cells& cells, const MatrixXd& energies,
                              const MatrixXd& initial) {
  const Eigen::ArrayXd sign = cells.velocity.array().sign();
  const Eigen::ArrayXd speed = cells.velocity.array().abs();
  const Eigen::ArrayXd u = speed / speed.maxCoeff();
  const Index m = cells.size();

  MatrixXd direction(m, 2), curve(m, 3), drift(m, 6);
  direction << VectorXd::Ones(m), speed.matrix();
  curve << (sign * u.square()).matrix(), (sign * (-u / 0.1).exp()).matrix(),
      (sign * (-u / 0.3).exp()).matrix();
  const Eigen::ArrayXd phase = std::numbers::pi * cells.time.array();
  for (int k = 1; k <= 4; ++k) drift.col(k - 1) = sign * (k * phase).cos();
  for (int k = 1; k <= 2; ++k) drift.col(3 + k) = (k * phase).cos();
  return {{Dependence::direction, direction},
          {Dependence::speed, curve},
          {Dependence::energy, sign.matrix().asDiagonal() * energies},
          {Dependence::initial_energy, initial},
          {Dependence::time, drift}};
}

/// Columns of norm 1 with their rows weighted; a column of zeros stays one.
MatrixXd Normed(const MatrixXd& columns, const VectorXd& roots) {
  MatrixXd normed = roots.asDiagonal() * columns;
  for (Index i = 0; i < normed.cols(); ++i) {
    const double norm = normed.col(i).norm();
    if (norm > 0) normed.col(i) /= norm;
  }
  return normed;
}

/// An orthonormal basis of columns, and how it is made of them: basis = columns * mix.
struct Basis {
  MatrixXd basis;  // [m x r]
  MatrixXd mix;    // [q x r]
};

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

/// The part of the recording that each cell belongs to; about as many samples in each. [m]
Eigen::VectorXi Parts(const Cells& cells, Index parts) {
  Eigen::VectorXi part(cells.size());
  const double total = cells.weight.sum();
  double before = 0;
  for (Index c = 0; c < cells.size(); ++c) {
    part[c] =
        static_cast<int>((before + 0.5 * cells.weight[c]) / total * static_cast<double>(parts));
    before += cells.weight[c];
  }
  return part;
}

/// The fit beside which blocks are tested; it grows with each that is found.
class GrowingFit {
 public:
  GrowingFit(const Cells& cells, const VectorXd& residual, const MatrixXd& derivatives)
      : roots_(cells.weight.cwiseSqrt()),
        parameters_(derivatives.cols()),
        parts_(std::min(kParts, cells.size() / 2)),
        part_(Parts(cells, parts_)),
        weighted_(roots_.asDiagonal() * derivatives),
        norms_(weighted_.colwise().norm().cwiseMax(1e-300)),
        columns_(Normed(derivatives, roots_)),
        residual_(roots_.cwiseProduct(residual)) {
    Refit();
  }

  /// What a block explains beyond the fit; nothing where that may be chance.
  std::optional<Structure> Test(const Block& block) const {
    if (block.features.cols() == 0) return std::nullopt;
    MatrixXd features = Normed(block.features, roots_);
    const MatrixXd shared = fit_.basis.transpose() * features;
    features -= fit_.basis * shared;
    const Basis own = Orthonormal(features, kDistinct);
    const Index q = own.basis.cols();
    const Index freedom = parts_ - columns_.cols() - q;
    if (q == 0 || freedom < 8) return std::nullopt;

    // the scores' scatter over the parts
    const VectorXd b = own.basis.transpose() * left_;
    const VectorXd rest = left_ - own.basis * b;
    MatrixXd scores = MatrixXd::Zero(q, parts_);
    for (Index c = 0; c < rest.size(); ++c) {
      scores.col(part_[c]) += rest[c] * own.basis.row(c).transpose();
    }
    const MatrixXd scatter =
        static_cast<double>(parts_) / static_cast<double>(freedom) * scores * scores.transpose();

    Structure structure;
    structure.on = block.on;
    structure.explained = b.squaredNorm() - scatter.trace();
    structure.deviations = HotellingDeviations(b, scatter, static_cast<double>(parts_));
    if (structure.deviations < kCertain || structure.explained <= 0) return std::nullopt;

    // the parameters give way: basis = features mix, whose share within the fit is `shared`
    const MatrixXd give = -(fit_.mix * shared * own.mix).topRows(parameters_);
    structure.moves = (give * b).cwiseQuotient(norms_.transpose());
    structure.move_deviations = (give * scatter * give.transpose())
                                    .diagonal()
                                    .cwiseMax(0)
                                    .cwiseSqrt()
                                    .cwiseQuotient(norms_.transpose());
    return structure;
  }

  void Take(const Block& block) {
    const MatrixXd features = Normed(block.features, roots_);
    columns_.conservativeResize(Eigen::NoChange, columns_.cols() + features.cols());
    columns_.rightCols(features.cols()) = features;
    Refit();
  }

  /// [m] what the fit takes up of the residual, N.m or N.
  VectorXd Explained() const { return (residual_ - left_).cwiseQuotient(roots_); }

 private:
  void Refit() {
    fit_ = Orthonormal(columns_, 1e-9);
    left_ = residual_ - fit_.basis * (fit_.basis.transpose() * residual_);
  }

  VectorXd roots_;  // [m] of the weights
  Index parameters_;
  Index parts_;
  Eigen::VectorXi part_;      // [m]
  MatrixXd weighted_;         // [m x p]
  Eigen::RowVectorXd norms_;  // [p]
  MatrixXd columns_;          // [m x (p + ...)] of norm 1
  VectorXd residual_;         // [m] weighted
  Basis fit_;
  VectorXd left_;  // [m] weighted
};

}  // namespace

SmoothFindings FindSmoothStructure(const Cells& cells, const VectorXd& residual,
                                   const MatrixXd& derivatives, const MatrixXd& energies,
                                   const MatrixXd& initial) {
  GrowingFit fit(cells, residual, derivatives);
  std::vector<Block> blocks = MakeBlocks(cells, energies, initial);
  SmoothFindings findings;
  while (!blocks.empty()) {
    // the block that explains most of what is left
    std::optional<Structure> most;
    size_t which = 0;
    for (size_t i = 0; i < blocks.size(); ++i) {
      std::optional<Structure> structure = fit.Test(blocks[i]);
      if (!structure || (most && structure->explained <= most->explained)) continue;
      most = std::move(structure);
      which = i;
    }
    if (!most) break;
    fit.Take(blocks[which]);
    blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(which));
    findings.found.push_back(std::move(*most));
  }
  findings.explained = fit.Explained();
  return findings;
}

}  // namespace warmjoint

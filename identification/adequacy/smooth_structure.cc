#include "identification/adequacy/smooth_structure.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "identification/adequacy/growing_fit.h"
#include "identification/linear/fit_gravity.h"

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<Block> MakeBlocks(const Cells& cells, const Circumstances& known) {
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
  const auto Signed = [&](const MatrixXd& columns) -> MatrixXd {
    return sign.matrix().asDiagonal() * columns;
  };
  return {
      {Dependence::direction, direction},
      {Dependence::speed, curve},
      {Dependence::energy, Signed(known.energies)},
      {Dependence::speed_by_energy, known.slopes},
      {Dependence::initial_energy, known.initial},
      {Dependence::load, Beside(Signed(known.loads), known.loads.leftCols(known.loads.cols() / 2))},
      {Dependence::temperature, Signed(known.temperatures)},
      {Dependence::time, drift}};
}

}  // namespace

SmoothFindings FindSmoothStructure(const Cells& cells, const VectorXd& residual,
                                   const MatrixXd& derivatives, const Circumstances& known) {
  const Selection all{Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(cells.size(), true), {}};
  std::vector<Block> blocks = MakeBlocks(cells, known);
  GrowingFit fit(cells.weight, residual, derivatives, all, blocks);
  SmoothFindings findings;
  while (!blocks.empty()) {
    // the block that explains what is left best
    std::optional<Structure> most;
    size_t which = 0;
    for (size_t i = 0; i < blocks.size(); ++i) {
      std::optional<Structure> structure = fit.Test(blocks[i]);
      if (!structure || (most && structure->merit <= most->merit)) continue;
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

}  // namespace warmjoint::inline identification

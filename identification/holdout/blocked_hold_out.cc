#include "identification/holdout/blocked_hold_out.h"

#include "identification/holdout/predict_torque.h"
#include "identification/inference/inference.h"

namespace warmjoint {

std::vector<Eigen::Index> CutIntoBlocks(const Selection& selection, int blocks) {
  std::vector<Eigen::Index> bounds{0};
  const Eigen::Index n = selection.keep.size();
  const Eigen::Index kept = selection.count();

  // a block ends once it has its share of the kept samples
  Eigen::Index seen = 0;
  for (Eigen::Index i = 0; i < n && static_cast<int>(bounds.size()) < blocks; ++i) {
    if (seen * blocks >= kept * static_cast<Eigen::Index>(bounds.size())) bounds.push_back(i);
    seen += selection.keep[i];
  }
  bounds.push_back(n);
  return bounds;
}

std::optional<Eigen::VectorXd> BlockedErrors(const Identifier& identifier,
                                             const IdentifierInput& input,
                                             const std::vector<Eigen::Index>& bounds) {
  Eigen::VectorXd errors(static_cast<Eigen::Index>(bounds.size()) - 1);
  for (size_t b = 0; b + 1 < bounds.size(); ++b) {
    // fit to all but the block, evaluate on the block alone
    const Eigen::Index length = bounds[b + 1] - bounds[b];
    Selection others = input.selection;
    others.keep.segment(bounds[b], length) = false;
    Selection block = input.selection;
    block.keep = block.keep && !others.keep;
    const IdentifierInput rest = input.With(others);
    const Fit fit = AtBounds(identifier.fit(rest), rest.measurements);
    const auto metrics = Evaluate(fit, input.measurements, block, fit.Start());
    if (!metrics) return std::nullopt;
    errors[static_cast<Eigen::Index>(b)] = metrics->rmse * metrics->rmse;
  }
  return errors;
}

}  // namespace warmjoint

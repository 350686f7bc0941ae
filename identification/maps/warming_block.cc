#include "identification/maps/warming_block.h"

#include <warmjoint/recording.h>

#include <cmath>

#include "identification/fit_data.h"
#include "identification/linear/linear_laws.h"
#include "identification/warming/further_passes.h"
#include "identification/warming/scan_time_constant.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

/// The loop of law columns and, with maps that are not 0, the maps' values as one column more.
ClosedLoop LoopOf(const Measurements& m, const Law& law, const MapBlock& maps) {
  const Eigen::MatrixXd columns = LawColumns(law, m.velocity), of_loss = LossColumns(law, m);
  const Eigen::VectorXd values = maps.Everywhere();
  if (!(values.norm() > 1e-9 * (columns * maps.fit().x.head(columns.cols())).norm())) {
    return ClosedLoop::Along(m, columns, of_loss);
  }
  return ClosedLoop::Along(m, ConcatColumns(columns, values),
                           of_loss.size() > 0 ? ConcatColumns(of_loss, values) : of_loss);
}

}  // namespace

WarmingBlock::WarmingBlock(const IdentifierInput& input, const MapTask& task,
                           const InitialEnergy& initial)
    : input_(input),
      task_(task),
      initial_(initial),
      gaps_(FindGaps(input.measurements)),
      kept_(WithoutRest(input.selection, input.measurements).keep.cast<double>()) {}

bool WarmingBlock::FitBeside(const MapBlock& maps) {
  const Measurements& m = input_.measurements;
  ClosedLoop loop = LoopOf(m, *task_.law, maps);
  const Eigen::VectorXd level = loop.direction().cwiseProduct(m.torque);

  // gravity and inertia make no heat: out of the scan, beside the loop in the fit
  const Eigen::MatrixXd offsets = loop.direction().asDiagonal() * task_.rigid.columns;
  const Eigen::VectorXd weights = maps.fit().x.segment(task_.law_count(), task_.rigid.count());
  InitialGuess from = ScanTimeConstant(loop, level - offsets * weights, kept_);
  if (fit_) from.thermal = fit_->thermal();
  const Eigen::Index d = from.parameters.size();
  from.parameters.conservativeResize(d + weights.size());
  from.parameters.tail(weights.size()) = weights;

  // what the maps left is about the noise
  const double scale = std::sqrt(maps.Squares() / static_cast<double>(input_.selection.count()));
  // jumps first beside a fit without them, which tells how warm the joint was, then with all else
  const bool jumps = !gaps_.empty(), first = !fit_;
  Eigen::VectorXd jump_weights;
  if (jumps && !first) {
    jump_weights = JumpWeights(
        scale, JumpSpread(gaps_, energy_.cwiseAbs().maxCoeff(), fit_->thermal().time_constant));
    loop = loop.WithJumps(Behind(gaps_));
  }
  // the fit of warming and rigid part; where it is the first, jumps follow it
  fit_ = FitThermalFriction(loop, level, offsets, kept_, from, initial_, scale, jump_weights);
  if (jumps && first) {
    FitJumps(loop, level, offsets, kept_, gaps_, from, *fit_);
  }
  // the energy by this warming, beside which the maps are fitted next
  energy_ = loop.Simulate(fit_->parameters(), fit_->thermal(), fit_->initial_energy(),
                          fit_->jump_values())
                .energy;
  return fit_->converged && energy_.allFinite();
}

}  // namespace warmjoint

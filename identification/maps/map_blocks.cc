#include "identification/maps/map_blocks.h"

#include <cmath>
#include <utility>

#include "identification/fit/fit_data.h"
#include "identification/linear/linear_laws.h"
#include "identification/warming/gaps.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

/// Law columns and, with maps that are not 0, the maps' values as one column more; gravity and inertia.
LawBlocks BlocksOf(const LogSamples& m, const MapTask& task, const MapBlock& maps) {
  const Law& law = *task.law;
  const Eigen::MatrixXd columns = LawColumns(law, m.velocity), of_loss = LossColumns(law, m);
  const Eigen::VectorXd values = maps.Everywhere();
  if (!(values.norm() > 1e-9 * (columns * maps.fit().law()).norm())) {
    return {m, columns, of_loss, task.rigid.columns};
  }
  return {m, ConcatColumns(columns, values),
          of_loss.size() > 0 ? ConcatColumns(of_loss, values) : of_loss, task.rigid.columns};
}

}  // namespace

MapBlock::MapBlock(const IdentifierInput& input, MapTask task)
    : input_(input), task_(std::move(task)), everywhere_(PointsOf(input.measurements)) {
  task_.energy = Eigen::VectorXd();
  if (task_.candidates.size() > 1) return;
  const std::vector<FrictionMap>& only = task_.candidates.front();
  task_.rows = KernelRows::Kept(only, Kept(everywhere_, input.selection),
                                task_.folds(input.selection.count()));
  all_rows_ = KernelRows::Kept(only, everywhere_, 1);
}

bool MapBlock::ChooseGiven(const Eigen::VectorXd& energy) {
  task_.energy = energy;
  chosen_ = Choose(input_, task_);
  if (!chosen_) return false;
  if (task_.candidates.size() > 1)
    all_rows_ = KernelRows::Kept(chosen_->problem.maps, everywhere_, 1);
  torque_ = chosen_->problem.torque;
  repeated_ = std::make_unique<RepeatedFit>(chosen_->problem, chosen_->normal, chosen_->strength);
  fit_ = repeated_->Fit();
  return fit_.has_value();
}

bool MapBlock::FitGiven(const Eigen::VectorXd& energy) {
  LeaveTo(energy);
  fit_ = repeated_->To(torque_);
  return fit_.has_value();
}

void MapBlock::Take(Eigen::VectorXd x, const Eigen::VectorXd& energy) {
  LeaveTo(energy);
  fit_ = repeated_->At(std::move(x));
}

void MapBlock::LeaveTo(const Eigen::VectorXd& energy) {
  task_.energy = energy;
  MapProblem& problem = chosen_->problem;
  if (!problem.rows) problem.rows = KernelRows::Kept(problem.maps, problem.points, 1);
  torque_ =
      Kept(input_.measurements.torque, input_.selection).col(0) - TorqueOfEnergy(input_, energy);
}

Eigen::VectorXd MapBlock::Everywhere() const {
  if (!all_rows_) return EvaluateMaps(fit_->maps, everywhere_);
  return all_rows_->Times(fit_->weights());
}

MapTask MapBlock::Settled() const {
  MapTask settled = warmjoint::Settled(task_, *fit_);
  settled.rows.reset();
  return settled;
}

WarmingBlock::WarmingBlock(const IdentifierInput& input, const MapTask& task,
                           const InitialEnergy& initial)
    : input_(input),
      task_(task),
      initial_(initial),
      starts_(FreeStarts(initial, input.measurements, input.selection)),
      gaps_(Merged(FindGaps(input.measurements), starts_)),
      kept_(WithoutRest(input.selection, input.measurements).keep) {}

bool WarmingBlock::FitGiven(const MapBlock& maps) {
  const LogSamples& m = input_.measurements;
  const LawBlocks blocks = BlocksOf(m, task_, maps);

  // gravity and inertia make no heat: they are left out of the scan, and are added to the loop in the fit
  const Eigen::VectorXd rigid = maps.fit().rigid();
  InitialGuess from =
      ScanTimeConstant(*blocks.loop, m.torque - task_.rigid.columns * rigid, kept_.cast<double>());
  if (fit_) from.thermal = fit_->thermal();
  const Eigen::Index d = from.parameters.size();
  from.parameters.conservativeResize(d + rigid.size());
  from.parameters.tail(rigid.size()) = rigid;

  // the residual of the maps is about as large as the noise
  ThermalRows rows{
      .blocks = blocks,
      .samples = {.torque = m.torque, .keep = kept_},
      .initial = initial_,
      .scale = std::sqrt(maps.Squares() / static_cast<double>(input_.selection.count())),
      .jump_samples = Behind(starts_),
      .jump_spread = JumpSpread(starts_, 0, 1)};
  // jumps are first added to a fit without them, which shows how warm the joint was, then estimated with all else
  const bool is_first = !fit_;
  if (!is_first) {
    rows.jump_samples = Behind(gaps_);
    rows.jump_spread =
        JumpSpread(gaps_, energy_.cwiseAbs().maxCoeff(), fit_->thermal().time_constant);
  }
  fit_ = FitThermalFriction(rows, from);
  if (is_first && gaps_.size() > starts_.size()) FitJumps(rows, gaps_, from, *fit_);
  // the energy by this warming, which is given when the maps are fitted next
  energy_ =
      blocks.loop->Simulate(fit_->law(), fit_->thermal(), fit_->initial_energy(), fit_->JumpsOfE())
          .energy;
  return fit_->converged && energy_.allFinite();
}

}  // namespace warmjoint

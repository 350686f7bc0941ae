#include "identification/maps/map_block.h"

#include "identification/fit_data.h"

namespace warmjoint {

MapBlock::MapBlock(const IdentifierInput& input, MapTask task)
    : input_(input), task_(std::move(task)), everywhere_(PointsOf(input.measurements)) {
  task_.energy = Eigen::VectorXd();
  if (task_.candidates.size() > 1) return;
  const std::vector<FrictionMap>& only = task_.candidates.front();
  task_.rows = KernelRows::Kept(only, Kept(everywhere_, input.selection),
                                task_.folds(input.selection.count()));
  all_rows_ = KernelRows::Kept(only, everywhere_, 1);
}

bool MapBlock::ChooseBeside(const Eigen::VectorXd& energy) {
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

bool MapBlock::FitBeside(const Eigen::VectorXd& energy) {
  task_.energy = energy;
  MapProblem& problem = chosen_->problem;
  if (!problem.rows) problem.rows = KernelRows::Kept(problem.maps, problem.points, 1);
  torque_ =
      Kept(input_.measurements.torque, input_.selection).col(0) - TakenByEnergy(input_, energy);
  fit_ = repeated_->To(torque_);
  return fit_.has_value();
}

Eigen::VectorXd MapBlock::Everywhere() const {
  if (!all_rows_) return EvaluateMaps(fit_->maps, everywhere_);
  return all_rows_->Times(fit_->x.tail(fit_->x.size() - fit_->free));
}

MapTask MapBlock::Settled() const {
  MapTask settled = warmjoint::Settled(task_, *fit_);
  settled.rows.reset();
  return settled;
}

}  // namespace warmjoint

#include "identification/warming/law_problem.h"

#include <utility>

#include "identification/fit/fit_data.h"
#include "identification/linear/linear_laws.h"

namespace warmjoint {

LawProblem::LawProblem(const IdentifierInput& input, const LinearTask& task)
    : input_(input),
      task_(task),
      blocks_(input.measurements, task.columns.leftCols(task.law_count()),
              LossColumns(task.law, input.measurements, task.load), task.gravity.columns) {}

RowTreatment LawProblem::AsMeasured() const {
  return {.torque = Kept(input_.measurements.torque, input_.selection)};
}

ModelSamples LawProblem::SamplesFor(const RowTreatment& rows) const {
  const Selection& selection = input_.selection;
  return {.torque = AmongAll(rows.torque, selection, 0),
          .keep = selection.keep,
          .weights = rows.weights.size() > 0 ? AmongAll(rows.weights, selection, 0) : rows.weights,
          .transform = rows.transform.get()};
}

ThermalRows LawProblem::RowsFor(const RowTreatment& rows, const InitialEnergy& initial,
                                double scale) const {
  return {.blocks = blocks_,
          .samples = SamplesFor(rows),
          .initial = initial,
          .scale = scale,
          .jump_samples = Behind(gaps_),
          .jump_spread = jump_spread_};
}

ThermalFit LawProblem::FitCold(const RowTreatment& rows) const {
  return FitWithoutHeat(blocks_, SamplesFor(rows));
}

ThermalFit LawProblem::FitWarm(const RowTreatment& rows, const InitialEnergy& initial,
                               const InitialGuess& start) const {
  return FitThermalFriction(RowsFor(rows, initial, rows.scale), start);
}

ThermalFit LawProblem::FitAgain(const RowTreatment& rows, const ThermalFit& fit) const {
  ThermalFit next = fit.has_heat() ? FitWarm(rows, fit.initial, StartFrom(fit)) : FitCold(rows);
  next.Follow(fit);
  return next;
}

InitialGuess LawProblem::Scan(const Eigen::VectorXd& torque, const ThermalFit& cold) const {
  const RigidPart& gravity = task_.gravity;
  const Eigen::VectorXd kept = input_.selection.keep.cast<double>();
  if (gravity.count() == 0) return ScanTimeConstant(*blocks_.loop, torque, kept);

  const ClosedLoop together = ClosedLoop::Along(input_.measurements, task_.columns);
  return ScanBeside({gravity.columns, cold.rigid()}, together, torque, kept);
}

ThermalResponse LawProblem::Respond(const ThermalFit& fit) const {
  ThermalResponse response;
  if (fit.has_heat()) {
    LoopResponse loop =
        blocks_.loop->Simulate(fit.law(), fit.thermal(), fit.initial_energy(), fit.JumpsOfE());
    response.force = std::move(loop.force);
    response.first_driving = loop.first_driving;
  } else {
    response.force = task_.columns.leftCols(task_.law_count()) * fit.law();
  }
  response.torque = response.force + task_.gravity.columns * fit.rigid();
  return response;
}

Eigen::MatrixXd LawProblem::JacobianOf(const ThermalFit& fit) {
  return ModelAt(*fit.model, fit.x).All().derivatives;
}

Uncertainty LawProblem::CovarianceOf(const ThermalFit& plain,
                                     const Eigen::VectorXd& residual) const {
  return warmjoint::CovarianceOf(
      {.rows = RowsFrom([&] { return Kept(JacobianOf(plain), input_.selection); }),
       .cofactor = plain.cofactor,
       .residual = residual,
       .selection = input_.selection,
       .prior = plain.prior});
}

void LawProblem::TakeJumps(const std::vector<LogGap>& gaps, const Eigen::VectorXd& spread) {
  gaps_ = gaps;
  jump_spread_ = spread;
}

}  // namespace warmjoint

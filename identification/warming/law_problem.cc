#include "identification/warming/law_problem.h"

#include <utility>

#include "identification/fit_data.h"
#include "identification/linear/linear_laws.h"
#include "identification/model/least_squares.h"

namespace warmjoint {
namespace {

/// [n] at the kept samples, 0 elsewhere: [N].
Eigen::VectorXd AtSamples(const Eigen::VectorXd& kept, const Selection& selection) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(selection.keep.size());
  Eigen::Index n = 0;
  for (Eigen::Index i = 0; i < all.size(); ++i) {
    if (selection.keep[i]) all[i] = kept[n++];
  }
  return all;
}

}  // namespace

LawProblem::LawProblem(const IdentifierInput& input, const LinearTask& task)
    : input_(input),
      task_(task),
      columns_(Kept(task.columns, input.selection)),
      torque_(Kept(input.measurements.torque, input.selection)),
      kept_(input.selection.keep.cast<double>()),
      loop_(ClosedLoop::Along(input.measurements, task.columns.leftCols(task.law_count()),
                              LossColumns(task.law, input.measurements, task.load))),
      level_(loop_.direction().cwiseProduct(input.measurements.torque)),
      offsets_(loop_.direction().asDiagonal() * task.gravity.columns) {}

ThermalFit LawProblem::FitCold(const RowTreatment& rows) const {
  // the rows with their weights and transform
  Eigen::MatrixXd A = columns_;
  Eigen::VectorXd y = rows.torque;
  if (rows.transform) {
    A = rows.transform->Of(A);
    y = rows.transform->Of(y);
  } else if (rows.weights.size() > 0) {
    const Eigen::VectorXd root = rows.weights.cwiseSqrt();
    A = root.asDiagonal() * A;
    y = root.cwiseProduct(y);
  }

  LeastSquares solved = SolveLeastSquares(A, y);
  ThermalFit fit;
  fit.layout =
      Layout::InOrder({{&Layout::law, task_.law_count()}, {&Layout::rigid, task_.gravity.count()}});
  fit.converged = solved.rank == A.cols();
  fit.mixed = std::move(solved.mixed);
  fit.squares = kInfinity;
  if (!fit.converged) return fit;
  fit.squares = (y - A * solved.solution).squaredNorm();
  fit.x = std::move(solved.solution);
  fit.cofactor = std::move(solved.cofactor);
  return fit;
}

ThermalFit LawProblem::FitWarm(const RowTreatment& rows, const InitialEnergy& initial,
                               const InitialGuess& start) const {
  const Selection& selection = input_.selection;
  // the torque and the weights of all samples, of which those that are not kept count nothing
  const Eigen::VectorXd level = loop_.direction().cwiseProduct(AtSamples(rows.torque, selection));
  const Eigen::VectorXd weight =
      rows.weights.size() > 0 ? AtSamples(rows.weights, selection) : kept_;
  return FitThermalFriction({.loop = loop_,
                             .level = level,
                             .offsets = offsets_,
                             .weight = weight,
                             .initial = initial,
                             .scale = rows.scale,
                             .jump_spread = jump_spread_,
                             .transform = rows.transform.get()},
                            start);
}

ThermalFit LawProblem::FitAgain(const RowTreatment& rows, const ThermalFit& fit) const {
  ThermalFit next = fit.has_heat() ? FitWarm(rows, fit.initial, StartFrom(fit)) : FitCold(rows);
  next.Follow(fit);
  return next;
}

InitialGuess LawProblem::Scan(const Eigen::VectorXd& torque, const ThermalFit& cold) const {
  const RigidPart& gravity = task_.gravity;
  const Eigen::VectorXd level = loop_.direction().cwiseProduct(torque);
  if (gravity.count() == 0) return ScanTimeConstant(loop_, level, kept_);

  // gravity of the fit without warming is subtracted, and its remaining error is scanned together with the law
  const ClosedLoop together = ClosedLoop::Along(input_.measurements, task_.columns);
  InitialGuess start = ScanTimeConstant(together, level - offsets_ * cold.rigid(), kept_);
  start.parameters.tail(gravity.count()) += cold.rigid();
  return start;
}

ThermalResponse LawProblem::Respond(const ThermalFit& fit) const {
  ThermalResponse response;
  if (fit.has_heat()) {
    LoopResponse loop = loop_.Simulate(fit.law(), fit.thermal(), fit.initial_energy(), fit.jumps());
    response.force = std::move(loop.force);
    response.first_driving = loop.first_driving;
  } else {
    response.force = task_.columns.leftCols(task_.law_count()) * fit.law();
  }
  response.torque = response.force + task_.gravity.columns * fit.rigid();
  return response;
}

Eigen::MatrixXd LawProblem::JacobianOf(const ThermalFit& fit) const {
  return fit.has_heat() ? WarmJacobian(loop_, task_.gravity.columns, fit) : task_.columns;
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
  loop_ = loop_.WithJumps(Behind(gaps));
}

Eigen::MatrixXd OfEstimated(const Eigen::MatrixXd& of, const Layout& layout) {
  Eigen::MatrixXd kept(of.rows(), layout.rigid.begin);
  kept << of.leftCols(layout.jumps.begin), of.rightCols(layout.jumps.size);
  return kept;
}

Eigen::MatrixXd WarmJacobian(const ClosedLoop& loop, const Eigen::MatrixXd& rigid,
                             const ThermalFit& fit) {
  const Thermal thermal = fit.thermal();
  Eigen::MatrixXd jacobian =
      OfEstimated(loop.Jacobian(fit.law(), thermal, fit.initial_energy(), fit.jumps()), fit.layout);
  jacobian.col(fit.layout.log_time_constant()) *= thermal.time_constant;  // from tau to log(tau)
  return ConcatColumns(jacobian, rigid);
}

EndEnergy WarmEnd(const ClosedLoop& loop, const ThermalFit& fit) {
  const LoopEnd end = loop.End(fit.law(), fit.thermal(), fit.initial_energy(), fit.jumps());
  return {end.energy, OfEstimated(end.slopes.transpose(), fit.layout).transpose()};
}

}  // namespace warmjoint

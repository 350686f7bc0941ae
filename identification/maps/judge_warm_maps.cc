#include "identification/maps/judge_warm_maps.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "identification/fit_data.h"
#include "identification/linear/linear_laws.h"
#include "identification/maps/holes.h"
#include "identification/uncertainty/penalised_uncertainty.h"

namespace warmjoint {
namespace {

/// Derivatives by x: law, rigid part, weights, k, log tau, E(0) where it was estimated, jumps.
struct JointDerivatives {
  Eigen::MatrixXd of_torque;         // [n x p] of F + G + M a at the kept samples
  Eigen::RowVectorXd of_end_energy;  // [p] of E at the end
};

/// dE/dx at the end, from where the joint moved last. all: [N x (d + 3 + J)] dF/dx of the loop.
Eigen::RowVectorXd OfEndEnergy(const ClosedLoop& loop, const Eigen::MatrixXd& all,
                               const Measurements& m, double time_constant) {
  Eigen::Index last = m.size() - 1;
  while (last > 0 && loop.direction()[last] == 0) --last;
  Eigen::RowVectorXd of_end = loop.direction()[last] * all.row(last);
  of_end.head(loop.levels().cols()) -= loop.levels().row(last);
  return of_end * std::exp((m.time[last] - m.time[m.size() - 1]) / time_constant);
}

JointDerivatives DerivativesOf(const IdentifierInput& input, const WarmMaps& warm) {
  const Measurements& m = input.measurements;
  const Law& nominal = *warm.task.law;
  // columns of law and kernels, and those of the losses where they differ
  const Eigen::MatrixXd law = LawColumns(nominal, m.velocity);
  const Eigen::MatrixXd of_loss = LossColumns(nominal, m);
  const Eigen::MatrixXd kernels = DenseKernels(warm.fit.maps, PointsOf(m), 0, m.size());
  const ClosedLoop loop =
      ClosedLoop::Along(m, ConcatColumns(law, kernels),
                        of_loss.size() > 0 ? ConcatColumns(of_loss, kernels) : of_loss)
          .WithJumps(Behind(warm.gaps));
  const Eigen::Index d = law.cols(), q = kernels.cols();
  Eigen::VectorXd level(d + q);
  level << warm.fit.x.head(d), warm.fit.x.tail(q);
  // derivatives at the fitted warming, with its start and its jumps
  const ThermalFit& warming = warm.warming;
  const Thermal thermal = warming.thermal();
  Eigen::MatrixXd all =
      loop.Jacobian(level, thermal, warming.initial_energy(), warming.jump_values());
  all.col(d + q + 1) *= thermal.time_constant;  // from tau to log(tau)
  const Eigen::RowVectorXd of_end = OfEndEnergy(loop, all, m, thermal.time_constant);

  // of E(0), only where it was estimated; the rigid part makes no heat
  const Eigen::Index heat = warming.estimates_initial_energy() ? 3 : 2;
  const auto jumps = warming.jump_weights.size();
  const Eigen::MatrixXd& rigid = warm.task.rigid.columns;
  Eigen::MatrixXd of_torque(m.size(), d + rigid.cols() + q + heat + jumps);
  of_torque << all.leftCols(d), rigid, all.middleCols(d, q + heat), all.rightCols(jumps);
  JointDerivatives joint{Kept(of_torque, input.selection), Eigen::RowVectorXd(of_torque.cols())};
  joint.of_end_energy << of_end.head(d), Eigen::RowVectorXd::Zero(rigid.cols()),
      of_end.segment(d, q + heat), of_end.tail(jumps);
  return joint;
}

/// What was known beforehand of what is told of the heat: k, log tau, E(0), jumps. [2 or 3, + J]
Eigen::VectorXd PriorOfHeat(const ThermalFit& warming) {
  const Eigen::VectorXd all = warming.prior();
  const Eigen::Index d = warming.law_parameters;
  return all.segment(d, all.size() - d - warming.offsets);
}

/// Of x. jacobian: [n x p]; residual: [n]
Uncertainty Judge(const IdentifierInput& input, const WarmMaps& warm,
                  const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual) {
  const Eigen::Index d = jacobian.cols();
  const Eigen::Index q = warm.fit.x.size() - warm.fit.free;
  // normal matrix of law, maps and warming together
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(d, d);
  gram.selfadjointView<Eigen::Lower>().rankUpdate(jacobian.transpose());
  gram.triangularView<Eigen::StrictlyUpper>() = gram.transpose();

  // columns of norm 1 for the inverse: the gain's are far from the others'
  Eigen::MatrixXd penalised = gram;
  auto of_weights = penalised.block(warm.fit.free, warm.fit.free, q, q);
  of_weights += PenaltyOf(warm.fit.maps, of_weights, warm.fit.unseen, warm.fit.strength);
  // what is known of the heat beforehand
  Eigen::VectorXd prior = Eigen::VectorXd::Zero(d);
  const Eigen::VectorXd of_heat = PriorOfHeat(warm.warming);
  prior.tail(of_heat.size()) = of_heat;
  penalised.diagonal() += prior;
  const Eigen::VectorXd scale = penalised.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> factors(scale.asDiagonal() * penalised * scale.asDiagonal());
  const Eigen::MatrixXd inverse =
      scale.asDiagonal() * factors.solve(Eigen::MatrixXd::Identity(d, d)) * scale.asDiagonal();
  // rows of samples, from the first to before the last
  const auto rows = [&](Eigen::Index first, Eigen::Index last) -> Eigen::MatrixXd {
    return jacobian.middleRows(first, last - first);
  };
  // independent weights: with those that go together gain and time constant are off by half of what is said
  return PenalisedCovariance(
      {gram, inverse, warm.fit.free, warm.fit.x.tail(q), warm.fit.strength, warm.fit.unseen, prior},
      rows, residual, input.selection);
}

}  // namespace

JointUncertainty JudgeWarmMaps(const IdentifierInput& input, const WarmMaps& warm,
                               const Eigen::VectorXd& residual) {
  const JointDerivatives joint = DerivativesOf(input, warm);
  const Eigen::RowVectorXd& of_end = joint.of_end_energy;
  JointUncertainty result{Judge(input, warm, joint.of_torque, residual)};
  result.end_energy_std = std::sqrt(of_end * result.known.covariance * of_end.transpose());
  return result;
}

}  // namespace warmjoint

#include "identification/adequacy/examine.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "identification/adequacy/angle_structure.h"
#include "identification/adequacy/cells.h"
#include "identification/adequacy/fading.h"
#include "identification/adequacy/fitted_model.h"
#include "identification/adequacy/lag.h"
#include "identification/adequacy/smooth_structure.h"
#include "identification/fit_data.h"
#include "identification/forward/thermal_filter.h"
#include "identification/linear/fit_gravity.h"
#include "identification/linear/least_squares.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/motor_angle.h"

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;

constexpr Index kFewestCells = 40;  // below, nothing can be said of structure
constexpr double kWarmStart = 0.1;  // of the warmth that the joint reaches
constexpr int kMotorHarmonics = 8;
constexpr double kFinestPosition = 128;  // cycles over the travel

/// The measured losses filtered with three time constants that span those of a recording.
/// torque: [N] less gravity; returns [N x 3].
Eigen::MatrixXd Energies(const Measurements& m, const Eigen::VectorXd& torque) {
  const double duration = m.time[m.size() - 1] - m.time[0];
  const Eigen::VectorXd loss = torque.cwiseProduct(m.velocity).cwiseAbs();
  const ThermalFilter filter(m.time, m.starts);
  Eigen::MatrixXd energies(m.size(), 3);
  for (int i = 0; i < 3; ++i) {
    energies.col(i) = filter.Energy({1, duration / std::array{40.0, 12.0, 3.0}[i]}, loss);
  }
  return energies;
}

/// energies: [N x 3]
Circumstances CircumstancesOf(const FittedModel& model, const Measurements& m,
                              const Eigen::MatrixXd& energies, const Cells& cells) {
  const Index c = cells.size();
  const Eigen::MatrixXd none(c, 0);
  Circumstances known{cells.Means(energies), none, none, none, none};
  if (model.knows_warming) known.slopes = cells.Means(m.velocity.cwiseProduct(model.energy));
  if (model.by_initial_energy) known.initial = cells.Means(*model.by_initial_energy);
  if (m.load) known.loads = cells.Means(Beside(*m.load, m.load->cwiseAbs()));
  if (m.temperature) known.temperatures = cells.Means(*m.temperature);
  return known;
}

std::optional<AngleAxis> MotorAxis(const Measurements& m) {
  if (!KnowsMotorAngle(m)) return std::nullopt;
  AngleAxis axis{Dependence::motor_angle, {}, 2 * std::numbers::pi, 1, kMotorHarmonics};
  const Eigen::ArrayXd turns = MotorPosition(m).array() / axis.length;
  axis.phase = turns - turns.floor();
  return axis;
}

/// The travel of the kept samples, down to periods that they show at half of the highest speed.
std::optional<AngleAxis> PositionAxis(const Measurements& m, const Selection& selection) {
  const Eigen::VectorXd kept = Kept(m.position, selection);
  const double lower = kept.minCoeff(), travel = kept.maxCoeff() - lower;
  const double step = MedianStep(m.time);
  const double finest = m.velocity.cwiseAbs().maxCoeff() * step;  // half a period
  if (!(travel > 0) || !std::isfinite(travel) || !(finest > 0)) return std::nullopt;
  const double cycles = std::min(
      {travel / finest, kFinestPosition, 0.5 * std::sqrt(static_cast<double>(kept.size()))});
  if (cycles < 1) return std::nullopt;
  AngleAxis axis{Dependence::position, {}, travel, 0.5, static_cast<int>(2 * cycles)};
  axis.phase = (m.position.array() - lower) / travel;
  return axis;
}

/// Adds the structure over angles to what is found; residual: [N], smooth structure taken off.
void FindRipple(const Measurements& m, const Selection& selection, Eigen::VectorXd residual,
                Adequacy& adequacy) {
  for (const auto& axis : {MotorAxis(m), PositionAxis(m, selection)}) {
    if (!axis) continue;
    // of one axis as one: the strongest frequency stands for all
    std::vector<Structure> found = FindAngleStructure(*axis, m.velocity, selection, residual);
    if (found.empty()) continue;
    for (size_t i = 1; i < found.size(); ++i) found[0].explained += found[i].explained;
    adequacy.found.push_back(std::move(found[0]));
  }
}

/// Sums up how the smooth structure moves the parameters.
void SumMoves(Index p, Adequacy& adequacy) {
  adequacy.moves.setZero(p);
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(p);
  for (const Structure& structure : adequacy.found) {
    adequacy.moves += structure.moves.head(p);
    variance += structure.move_deviations.head(p).cwiseAbs2();
  }
  adequacy.move_deviations = variance.cwiseSqrt();
}

/// How the parameters of a fit move with each force that it leaves out, N.m or N. derivatives: [m x
/// p]; forces: [m x q]; [p x q]
Eigen::MatrixXd MovesBy(const Eigen::MatrixXd& forces, const Cells& cells,
                        const Eigen::MatrixXd& derivatives) {
  const Eigen::VectorXd root = cells.weight.cwiseSqrt();
  const Eigen::MatrixXd weighted = root.asDiagonal() * derivatives;
  return -weighted.colPivHouseholderQr().solve(root.asDiagonal() * forces);
}

/// What following the heat within the steps of the log would change, and whether the residual
/// tells that it does; its force joins the derivatives. derivatives: [m x (p + ...)]
void LearnHeat(const FittedModel& model, const Cells& cells, Index p, Eigen::MatrixXd& derivatives,
               Adequacy& adequacy) {
  if (!model.held_loss) return;
  const Eigen::MatrixXd force = cells.Means(*model.held_loss);
  adequacy.by_heat = MovesBy(force, cells, derivatives).topRows(p);
  derivatives = Beside(derivatives, force);
  const Eigen::VectorXd root = cells.weight.cwiseSqrt();
  const Eigen::MatrixXd weighted = root.asDiagonal() * derivatives;
  const Eigen::VectorXd residual = root.asDiagonal() * cells.Means(model.residual);
  const LeastSquares fit = SolveLeastSquares(weighted, residual);
  adequacy.heat_deviation = kInfinity;
  const Index q = derivatives.cols() - 1, free = cells.size() - q - 1;
  if (!fit.mixed.empty() || free < 1) return;
  const double variance =
      (residual - weighted * fit.solution).squaredNorm() / static_cast<double>(free);
  adequacy.heat_share = fit.solution[q];
  adequacy.heat_deviation = std::sqrt(variance * fit.cofactor(q, q));
}

}  // namespace

double Adequacy::Rms(const Structure& structure) const {
  return std::sqrt(structure.explained / samples);
}

Adequacy ExamineResidual(const Fit& fit, const Inference& inference, const Measurements& m,
                         const Selection& selection) {
  Adequacy adequacy;
  const std::optional<FittedModel> model = EvaluateModel(fit, inference, m, selection);
  if (!model || !model->residual.allFinite() || !model->derivatives.allFinite()) return adequacy;
  const Cells cells = MakeCells(m, model->selection);
  if (cells.size() < kFewestCells) return adequacy;

  adequacy.samples = cells.weight.sum();
  adequacy.friction =
      std::sqrt(Kept(model->torque, model->selection).squaredNorm() / adequacy.samples);
  adequacy.squares = Kept(model->residual, model->selection).squaredNorm();
  adequacy.rows = model->rows;
  Eigen::MatrixXd derivatives = cells.Means(model->derivatives);
  const Index jumps = model->jump_spread.size(), p = derivatives.cols() - jumps;
  adequacy.reach =
      (cells.weight.cwiseSqrt().asDiagonal() * derivatives.leftCols(p)).colwise().norm() /
      std::sqrt(adequacy.samples);

  LearnHeat(*model, cells, p, derivatives, adequacy);

  // what changes from segment to segment, then what changes within
  const Eigen::MatrixXd energies = Energies(m, model->torque);
  SmoothFindings smooth = FindSmoothStructure(cells, cells.Means(model->residual), derivatives,
                                              CircumstancesOf(*model, m, energies, cells));
  adequacy.found = std::move(smooth.found);
  Eigen::VectorXd rest = model->residual;
  for (Index c = 0; c < cells.size(); ++c) {
    const auto i = static_cast<size_t>(c);
    rest.segment(cells.begin[i], cells.end[i] - cells.begin[i]).array() -= smooth.explained[c];
  }
  if (auto fading = FindFading(*model, rest)) adequacy.found.push_back(*fading);
  SumMoves(p, adequacy);
  if (model->by_initial_energy) {
    const double energy = kWarmStart * model->energy.cwiseAbs().maxCoeff();
    adequacy.by_start =
        MovesBy(energy * cells.Means(*model->by_initial_energy), cells, derivatives).topRows(p);
  }
  if (jumps > 0 && fit.jump_samples.empty()) {
    const Eigen::MatrixXd forces =
        derivatives.middleCols(p, jumps) * model->jump_spread.asDiagonal();
    adequacy.by_gaps = MovesBy(forces, cells, derivatives.leftCols(p)).cwiseAbs().rowwise().sum();
  }
  if (auto lag = FindLag(*model, m, rest)) adequacy.found.push_back(*lag);
  FindRipple(m, model->selection, std::move(rest), adequacy);
  std::sort(adequacy.found.begin(), adequacy.found.end(),
            [](const Structure& a, const Structure& b) { return a.explained > b.explained; });
  return adequacy;
}

}  // namespace warmjoint::inline identification

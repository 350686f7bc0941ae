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

namespace warmjoint {
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
  if (model.KnowsWarming()) known.slopes = cells.Means(m.velocity.cwiseProduct(model.energy));
  if (model.by_initial_energy) known.initial = cells.Means(*model.by_initial_energy);
  if (m.load) known.loads = cells.Means(Beside(*m.load, m.load->cwiseAbs()));
  if (m.temperature) known.temperatures = cells.Means(*m.temperature);
  return known;
}

std::optional<AngleAxis> MotorAxis(const Measurements& m) {
  if (!m.motor_position && std::abs(m.gear) == 1) return std::nullopt;
  AngleAxis axis{Dependence::motor_angle, {}, 2 * std::numbers::pi, 1, kMotorHarmonics};
  const Eigen::ArrayXd turns =
      (m.motor_position ? *m.motor_position : Eigen::VectorXd(m.gear * m.position)).array() /
      axis.length;
  axis.phase = turns - turns.floor();
  return axis;
}

/// The travel of the kept samples, down to periods that they show at half of the highest speed.
std::optional<AngleAxis> PositionAxis(const Measurements& m, const Selection& selection) {
  const Eigen::VectorXd kept = Kept(m.position, selection);
  const double lower = kept.minCoeff(), travel = kept.maxCoeff() - lower;
  const double step = (m.time[m.size() - 1] - m.time[0]) / static_cast<double>(m.size() - 1);
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
    adequacy.moves += structure.moves;
    variance += structure.move_deviations.cwiseAbs2();
  }
  adequacy.move_deviations = variance.cwiseSqrt();
}

/// How the parameters of a fit move when its start is warm by `energy`. by_start: [m x 1] dF/dE(0)
Eigen::VectorXd MovesByStart(const Cells& cells, const Eigen::MatrixXd& derivatives,
                             const Eigen::MatrixXd& by_start, double energy) {
  const Eigen::VectorXd root = cells.weight.cwiseSqrt();
  const Eigen::MatrixXd weighted = root.asDiagonal() * derivatives;
  return -energy * weighted.colPivHouseholderQr().solve(root.asDiagonal() * by_start);
}

}  // namespace

double Adequacy::Rms(const Structure& structure) const {
  return std::sqrt(structure.explained / samples);
}

Adequacy ExamineResidual(const Identifier& identifier, const IdentifierInput& input,
                         const Estimate& estimate) {
  Adequacy adequacy;
  const std::optional<FittedModel> model = EvaluateModel(identifier, input, estimate);
  if (!model || !model->residual.allFinite() || !model->derivatives.allFinite()) return adequacy;
  const Measurements& m = input.measurements;
  const Cells cells = MakeCells(m, model->selection);
  if (cells.size() < kFewestCells) return adequacy;

  adequacy.samples = cells.weight.sum();
  adequacy.friction =
      std::sqrt(Kept(model->torque, model->selection).squaredNorm() / adequacy.samples);
  adequacy.squares = Kept(model->residual, model->selection).squaredNorm();
  adequacy.names = model->names;
  const Eigen::MatrixXd derivatives = cells.Means(model->derivatives);
  adequacy.reach = (cells.weight.cwiseSqrt().asDiagonal() * derivatives).colwise().norm() /
                   std::sqrt(adequacy.samples);

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
  SumMoves(static_cast<Index>(model->names.size()), adequacy);
  if (model->by_initial_energy) {
    adequacy.by_start = MovesByStart(cells, derivatives, cells.Means(*model->by_initial_energy),
                                     kWarmStart * model->energy.cwiseAbs().maxCoeff());
  }
  if (auto lag = FindLag(*model, m, rest)) adequacy.found.push_back(*lag);
  FindRipple(m, model->selection, std::move(rest), adequacy);
  std::sort(adequacy.found.begin(), adequacy.found.end(),
            [](const Structure& a, const Structure& b) { return a.explained > b.explained; });
  return adequacy;
}

}  // namespace warmjoint

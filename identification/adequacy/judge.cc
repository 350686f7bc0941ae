#include "identification/adequacy/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "identification/adequacy/angle_structure.h"
#include "identification/adequacy/cells.h"
#include "identification/adequacy/fitted_model.h"
#include "identification/adequacy/smooth_structure.h"
#include "identification/adequacy/words.h"
#include "identification/finer_input.h"
#include "identification/fit_data.h"
#include "identification/thermal_filter.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr double kLarge = 0.05;     // of the friction, rms
constexpr double kNotable = 0.02;   // of the friction, rms, where it also is
constexpr double kVisible = 0.2;    // of the residual's variance
constexpr Index kFewestCells = 40;  // below, nothing can be said of structure
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

/// Whether structure that explains so much is more than a detail.
bool IsLarge(double explained, const Adequacy& adequacy) {
  const double size = std::sqrt(explained / adequacy.samples) / adequacy.friction;
  return size > kLarge || (size > kNotable && explained > kVisible * adequacy.squares);
}

/// The parameter that structure moves farthest beyond its interval, by a twentieth of the friction
/// at least; -1 where there is none.
Index Misled(const Adequacy& adequacy, const Estimate& estimate) {
  Index worst = -1;
  double most = kLarge * adequacy.friction;
  for (Index i = 0; i < adequacy.moves.size(); ++i) {
    const EstimatedParameter* parameter = estimate.Find(adequacy.names[static_cast<size_t>(i)]);
    const double move = std::abs(adequacy.moves[i]);
    const double half = parameter->interval95
                            ? 0.5 * ((*parameter->interval95)[1] - (*parameter->interval95)[0])
                            : 0;
    if (move < kCertain * adequacy.move_deviations[i] || move < half) continue;
    if (move * adequacy.reach[i] < most) continue;
    most = move * adequacy.reach[i];
    worst = i;
  }
  return worst;
}

/// Lets intervals reach as far as the structure moves the parameters.
void Widen(const Adequacy& adequacy, Estimate& estimate) {
  for (EstimatedParameter& parameter : estimate.parameters) {
    if (!parameter.interval95) continue;
    const auto named = std::find(adequacy.names.begin(), adequacy.names.end(), parameter.name);
    if (named == adequacy.names.end()) continue;
    const double move = std::abs(adequacy.moves[named - adequacy.names.begin()]);
    (*parameter.interval95)[0] -= move;
    (*parameter.interval95)[1] += move;
  }
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
  Eigen::MatrixXd initial(cells.size(), 0);
  if (model->by_initial_energy) initial = cells.Means(*model->by_initial_energy);
  SmoothFindings smooth = FindSmoothStructure(cells, cells.Means(model->residual), derivatives,
                                              cells.Means(Energies(m, model->torque)), initial);
  adequacy.found = std::move(smooth.found);
  SumMoves(static_cast<Index>(model->names.size()), adequacy);
  Eigen::VectorXd rest = model->residual;
  for (Index c = 0; c < cells.size(); ++c) {
    const auto i = static_cast<size_t>(c);
    rest.segment(cells.begin[i], cells.end[i] - cells.begin[i]).array() -= smooth.explained[c];
  }
  FindRipple(m, model->selection, std::move(rest), adequacy);
  std::sort(adequacy.found.begin(), adequacy.found.end(),
            [](const Structure& a, const Structure& b) { return a.explained > b.explained; });
  return adequacy;
}

void JudgeAdequacy(const Identifier& identifier, const IdentifierInput& input, Estimate& estimate) {
  if (estimate.status != Status::ok) return;
  const Adequacy adequacy = ExamineResidual(identifier, input, estimate);
  if (adequacy.found.empty()) return;

  std::vector<std::string> words;
  double explained = 0;
  for (const Structure& structure : adequacy.found) {
    words.push_back(DescribeStructure(adequacy, structure, input.measurements));
    explained += structure.explained;
  }
  const std::string depends =
      fmt::format("the residual depends on {}", fmt::join(words, "; and on "));
  const std::string remedy = Remedy(adequacy.found[0], identifier, input, estimate);
  const Index misled = Misled(adequacy, estimate);
  if (IsLarge(explained, adequacy) || misled >= 0) {
    const std::string moves = misled < 0 ? ""
                                         : fmt::format("; with it {} would move by {:.3g}",
                                                       adequacy.names[static_cast<size_t>(misled)],
                                                       adequacy.moves[misled]);
    estimate.bands.clear();
    Void(Status::inadequate_model, fmt::format("{}{}; {}", depends, moves, remedy), estimate);
    return;
  }
  estimate.message +=
      fmt::format("; {}: the intervals reach as far as that moves them; {}", depends, remedy);
  Widen(adequacy, estimate);
}

Estimate WithVoidNumbers(const Estimate& judged, const Estimate& before) {
  if (judged.status == before.status) return judged;
  Estimate shown = judged;
  shown.parameters = before.parameters;
  shown.friction = before.friction;
  shown.bands = before.bands;
  shown.message += "; forced: all numbers are void";
  return shown;
}

Estimate IdentifyAndJudge(const Identifier& identifier, const IdentifierInput& given) {
  const FinerInput finer(identifier, given);
  Estimate estimate = identifier.identify(finer.input());
  JudgeAdequacy(identifier, finer.input(), estimate);
  TellUnseenReversals(finer.unseen(), estimate);
  return estimate;
}

}  // namespace warmjoint

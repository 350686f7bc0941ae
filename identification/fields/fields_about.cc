#include "identification/fields/fields_about.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "identification/fields/field_evidence.h"
#include "identification/fields/field_figures.h"
#include "identification/fields/field_rows.h"
#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/fit/seen_samples.h"
#include "identification/inference/bounds.h"
#include "identification/linear/linear_laws.h"
#include "identification/sentences/fields.h"
#include "identification/uncertainty/tails.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kWarmer = 1;      // K; why: thermometers of drives have steps of that size
constexpr Index kFewestRows = 60;  // why: fewer do not show how noise is correlated

/// Columns that stand in a fit with fields alone: a constant torque, which a field over the place has as its mean.
MatrixXd ConstantOf(const Fit& fit, const Law& law, const LogSamples& m) {
  const bool constant = fit.model.gravity && fit.model.gravity->kind != GravityKind::sincos;
  const bool has = !constant && IsSymmetric(law) && OnlyWay(Kept(m.velocity, fit.rows.used)) == 0;
  return MatrixXd::Ones(m.size(), has ? 1 : 0);
}

/// Whether the joint's temperature was logged and changed.
bool GetsWarmer(const Fit& fit, const LogSamples& m) {
  if (!m.temperature || !m.temperature->allFinite()) return false;
  const VectorXd temperature = Kept(*m.temperature, fit.rows.used);
  return temperature.maxCoeff() - temperature.minCoeff() > kWarmer;
}

/// The fields that a log can have: over the place where gravity has not every place, over place and speed where these vary.
std::vector<FieldKind> Possible(const FieldSet& asked, const Fit& fit, const LogSamples& m) {
  const VectorXd position = Kept(m.position, fit.rows.used);
  const VectorXd speed = Kept(m.velocity, fit.rows.used).cwiseAbs();
  const bool travels = position.maxCoeff() > position.minCoeff() && !m.position_integrated;
  std::vector<FieldKind> kinds;
  for (const FieldKind kind : asked.kinds) {
    const bool over_place = kind == FieldKind::place_torque || kind == FieldKind::place_friction;
    if (over_place && !travels) continue;
    if (kind == FieldKind::place_torque && fit.model.gravity &&
        fit.model.gravity->kind == GravityKind::paired) {
      continue;
    }
    // of a drift beside a warming no likelihood decides (the tests for lack of fit do); a temperature is its rival
    const bool changes =
        kind == FieldKind::time_friction || kind == FieldKind::temperature_friction;
    if (changes && fit.model.friction.thermal) continue;
    if (kind == FieldKind::temperature_friction && !GetsWarmer(fit, m)) continue;
    if (kind == FieldKind::speed_friction && !(speed.maxCoeff() > speed.minCoeff())) continue;
    kinds.push_back(kind);
  }
  return kinds;
}

/// rms friction of law and heat over the rows, or of what it leaves, whichever is larger: the unit of amplitudes.
double FrictionOver(const FieldRows& rows, const Fit& fit) {
  const VectorXd x = UnknownsOf(fit);
  VectorXd friction = VectorXd::Zero(rows.size());
  Index column = 0;
  for (const Unknown& row : fit.parameters) {
    if (!row.estimated) continue;
    if (row.role == Role::law || row.role == Role::load)
      friction += rows.flat.col(column) * x[column];
    ++column;
  }
  const VectorXd left = rows.torque - rows.flat.leftCols(x.size()) * x;
  return std::sqrt(std::max(friction.squaredNorm(), left.squaredNorm()) /
                   static_cast<double>(rows.size()));
}

/// Amplitude of a field, a share of the friction; 0 without it.
double AmplitudeOf(FieldKind kind, const SolvedFields& solved) {
  for (size_t k = 0; k < solved.blocks.size(); ++k) {
    if (solved.blocks[k].kind == kind) return solved.best.amplitudes[k];
  }
  return 0;
}

/// -2 log of the marginal likelihood, with a prior of the heat: E as large as the friction, its time constant within a factor of e.
double CostOf(const Fit& fit, const FieldRows& rows, double friction, double without_heat) {
  double cost = without_heat;
  Index column = 0;
  for (const Unknown& row : fit.parameters) {
    if (!row.estimated) continue;
    if (row.role == Role::gain) {
      const double along = rows.flat.col(column).squaredNorm() / static_cast<double>(rows.size());
      cost -= std::log(along / (friction * friction));
    }
    ++column;
  }
  return cost;
}

/// How much the friction changes over time: rms about its mean, a share of the friction.
double DriftOf(const SolvedFields& solved, double friction) {
  const VectorXd drift = FrictionOverTime(solved);
  if (drift.size() == 0) return 0;
  return std::sqrt((drift.array() - drift.mean()).square().mean()) / friction;
}

/// By how much the friction changes a kelvin, N.m/K or N/K, the mean over the temperatures; nothing where there is no such field.
std::optional<double> ByTemperature(const SolvedFields& solved) {
  if (AmplitudeOf(FieldKind::temperature_friction, solved) == 0) return std::nullopt;
  const auto block =
      std::ranges::find(solved.blocks, FieldKind::temperature_friction, &FieldBlock::kind);
  const VectorXd values = solved.ValuesOf(static_cast<size_t>(block - solved.blocks.begin()));
  const VectorXd& at = block->knots.at;
  return (values[values.size() - 1] - values[0]) / (at[at.size() - 1] - at[0]);
}

/// Conditions a posterior on rows of the law that are at their bounds. report: [p x p + m]
void Condition(const LeftByNoise& left, const MatrixXd& report, FieldPosterior& posterior) {
  const MatrixXd of = report(left.columns, Eigen::all);
  const MatrixXd pull = posterior.covariance * of.transpose();
  const Eigen::Map<const VectorXd> gaps(left.gaps.data(), std::ssize(left.gaps));
  posterior.mean += pull * (of * pull).ldlt().solve(gaps);
}

/// Whether a fit is linear in its unknowns.
bool IsLinear(const Fit& fit) {
  return !fit.model.friction.thermal && !fit.RowOf(Role::load) && !fit.RowOf(Role::delay);
}

constexpr int kMostRounds = 4;
constexpr double kRests = 0.1;  // deviations; why: such a step changes no interval by a hundredth

/// A fit to what fields leave of the torque, and the fields about it.
struct Round {
  FitForFields at;
  FieldRows rows{};
  std::vector<FieldBlock> blocks{};
  double friction = 0;  // N.m or N
  std::unique_ptr<const FieldEvidence> evidence{};
  FieldHyperparameters best{};
  FieldPosterior posterior{};

  SolvedFields solved() const { return {rows, blocks, *evidence, best, posterior}; }
  /// Whether x of the posterior is that of the fit.
  bool Rests() const {
    const VectorXd x = UnknownsOf(at.fit);
    const Eigen::ArrayXd deviation = posterior.covariance.diagonal().head(x.size()).cwiseSqrt();
    return ((posterior.mean.head(x.size()) - x).array().abs() <= kRests * deviation).all();
  }
};

/// asked: the fields; left_out: [N] of the torque, that the fit did not see
std::unique_ptr<Round> Solve(FitForFields at, const FieldSet& asked, const VectorXd& left_out) {
  auto round = std::make_unique<Round>();
  round->at = std::move(at);
  const Fit& fit = round->at.fit;
  const LogSamples& m = round->at.motion;
  const Law& law = *FindLaw(fit.model.friction.law);
  round->rows = MakeFieldRows(fit, m, ConstantOf(fit, law, m), left_out);
  round->rows.prior_mean = round->at.prior_mean;
  round->rows.prior_precision = round->at.prior_precision;
  if (round->rows.size() < kFewestRows) return round;
  round->friction = FrictionOver(round->rows, fit);
  round->blocks = MakeFields(Possible(asked, fit, m), round->rows, m.joint, law);
  round->evidence =
      std::make_unique<const FieldEvidence>(round->rows, round->blocks, round->friction);
  round->best = round->evidence->Maximise();
  round->posterior = round->evidence->At(round->best);
  return round;
}

/// F + G + M a of law and fields at the posterior. [N] N.m or N
VectorXd TorqueAt(const Round& round, const SolvedFields& solved) {
  const FitForFields& at = round.at;
  const VectorXd x = UnknownsOf(at.fit);
  return at.torque_of(at.fit, at.motion) +
         at.fit.rows.jacobian() * (solved.posterior.mean.head(x.size()) - x) +
         FieldsAlong(solved, x.size(), at.motion);
}

/// The answer: the fit moved to the posterior, with what fields add to it.
Fit Conclude(const Round& round) {
  const LogSamples& m = round.at.motion;
  Fit fit = round.at.fit;
  SolvedFields solved = round.solved();
  const FieldFigures figures(solved, round.at.fit, m);
  VectorXd torque = TorqueAt(round, solved);
  fit.rows.torque = Kept(m.torque, fit.rows.used);
  fit.rows.fitted = Kept(torque, fit.rows.used);
  fit.rows.effective_parameters = round.evidence->EffectiveParameters(round.best);
  const Uncertainty uncertainty =
      figures.UncertaintyOf(fit.rows.residual(), fit.rows.effective_parameters);
  HoldAt(figures.Reported(), {}, fit);
  fit.figures.end_energy = nullptr;
  fit.rows.errors = {};
  fit.rows.errors.covariance = [uncertainty] { return uncertainty; };
  // what noise puts beyond the bounds of the law
  if (auto left = FindLeftByNoise(fit, ByNoise(fit))) {
    Condition(*left, figures.report(), solved.posterior);
    torque = TorqueAt(round, solved);
    fit.rows.fitted = Kept(torque, fit.rows.used);
    Cause held = HoldAt(figures.Reported(), left->columns, fit);
    held.sentence = std::move(left->sentence);
    fit.causes.push_back(std::move(held));
  }
  if (figures.Falls()) {
    for (Unknown& row : fit.parameters) {
      if (row.role == Role::law && row.part == LawPart::slope) row.has_interval = false;
    }
    fit.causes.push_back(Note(kFrictionFalls));
  }
  const double cost = round.evidence->Cost(round.best);
  fit.figures.fields = FittedFields{.cost = CostOf(round.at.fit, round.rows, round.friction, cost),
                                    .time_torque = AmplitudeOf(FieldKind::time_torque, solved),
                                    .time_friction = DriftOf(solved, round.friction)};
  for (const FieldBlock& block : round.blocks)
    fit.figures.fields->present.kinds.push_back(block.kind);
  figures.AddTo(uncertainty.degrees_of_freedom, fit);
  fit.rows.rest = torque - round.at.torque_of(fit, m);
  fit.rows.count += static_cast<int>(round.evidence->size() - UnknownsOf(fit).size());
  // what the friction file leaves out: the parts of fields that may be chance, and what lies between the centres of maps
  const VectorXd left_out = Kept(VectorXd(fit.rows.rest - DriftAlong(solved, m)), fit.rows.used);
  const std::vector<FieldShare> shares = figures.Shares(round.friction);
  fit.summary += SummaryOfFields(shares, left_out.cwiseAbs().maxCoeff() / round.friction);
  if (const auto slope = ByTemperature(solved)) {
    fit.causes.push_back(Note(ExplainTemperature(*slope, m.torque_unit)));
  }
  if (std::ranges::count(shares, FieldKind::time_friction, &FieldShare::kind) > 0) {
    fit.causes.push_back(Note(ExplainMeansOverLog(fit.figures.fields->time_friction)));
  }
  return fit;
}

}  // namespace

Fit WithFieldsAbout(FitForFields first, const FieldSet& asked, const FitToTheRest& again) {
  const VectorXd nothing = VectorXd::Zero(first.motion.size());
  auto round = Solve(std::move(first), asked, nothing);
  if (!round->evidence) {
    Fit plain = std::move(round->at.fit);
    plain.causes.push_back(Note(ExplainFewFieldRows(round->rows.size(), kFewestRows)));
    return plain;
  }

  // the fit once more to what the fields leave, and the fields about that
  for (int i = 1; i < kMostRounds && !IsLinear(round->at.fit) && !round->Rests(); ++i) {
    const VectorXd held =
        FieldsAlong(round->solved(), UnknownsOf(round->at.fit).size(), round->at.motion);
    std::optional<FitForFields> next = again(held);
    if (!next || next->fit.parameters.size() != round->at.fit.parameters.size()) break;
    auto other = Solve(*std::move(next), asked, held);
    if (!other->evidence) break;
    round = std::move(other);
  }
  round->posterior = round->evidence->Averaged(round->best);
  return Conclude(*round);
}

}  // namespace warmjoint

#include "identification/fields/fit_fields.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <utility>

#include "identification/fields/field_evidence.h"
#include "identification/fields/field_figures.h"
#include "identification/fields/field_rows.h"
#include "identification/fit_data.h"
#include "identification/fit_parameters.h"
#include "identification/forward/log_trajectory.h"
#include "identification/inference/bounds.h"
#include "identification/linear/linear_laws.h"
#include "identification/seen_samples.h"
#include "identification/sentences/fields.h"
#include "identification/uncertainty/tails.h"
#include "identification/warming/initial_energy.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kFewestRows = 60;  // why: fewer do not show how noise is correlated

/// Why a fit has no fields, where it could not have any; empty where nothing is left for them.
std::optional<std::string> WhyNone(const Fit& fit) {
  if (!fit.friction.maps.empty()) return kNoFieldsBesideMaps;
  if (fit.torque_lag || fit.loss_bend) return kNoFieldsBesideLag;
  if (IsRounding(fit.residual().squaredNorm(), fit.torque)) return "";
  if (!fit.jacobian || fit.errors.covariance) return kNoFieldsBesideCovariance;
  return std::nullopt;
}

/// Columns that stand in a fit with fields alone: a constant torque, which a field over the place has as its mean.
MatrixXd ConstantOf(const Fit& fit, const Law& law, const LogSamples& m) {
  const bool constant = fit.gravity && fit.gravity->kind != GravityKind::sincos;
  const bool has = !constant && IsSymmetric(law) && OnlyWay(Kept(m.velocity, fit.used)) == 0;
  return MatrixXd::Ones(m.size(), has ? 1 : 0);
}

/// The fields that a log can have: over the place where gravity has not every place, over place and speed where these vary.
std::vector<FieldKind> Possible(const FieldSet& asked, const Fit& fit, const LogSamples& m) {
  const VectorXd position = Kept(m.position, fit.used);
  const VectorXd speed = Kept(m.velocity, fit.used).cwiseAbs();
  const bool travels = position.maxCoeff() > position.minCoeff() && !m.position_integrated;
  std::vector<FieldKind> kinds;
  for (const FieldKind kind : asked.kinds) {
    const bool over_place = kind == FieldKind::place_torque || kind == FieldKind::place_friction;
    if (over_place && !travels) continue;
    if (kind == FieldKind::place_torque && fit.gravity &&
        fit.gravity->kind == GravityKind::paired) {
      continue;
    }
    // of a drift beside a warming no likelihood decides (the tests for lack of fit do)
    if (kind == FieldKind::time_friction && fit.friction.thermal) continue;
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
  for (const FitParameter& row : fit.parameters) {
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

/// How much the friction changes over time: rms about its mean, a share of the friction.
double DriftOf(const SolvedFields& solved, double friction) {
  for (size_t k = 0; k < solved.blocks.size(); ++k) {
    const FieldBlock& block = solved.blocks[k];
    if (block.kind != FieldKind::time_friction) continue;
    const FieldRows& rows = solved.rows;
    const VectorXd drift =
        block.UnsignedAt(rows.time, rows.position, rows.velocity) * solved.ValuesOf(k);
    return std::sqrt((drift.array() - drift.mean()).square().mean()) / friction;
  }
  return 0;
}

/// Changes the table and the model to x, [p]. held: columns of rows that are at a bound
void Take(const VectorXd& x, const std::vector<Index>& held, Fit& fit) {
  Index column = 0, gravity = 0;
  for (FitParameter& row : fit.parameters) {
    if (!row.estimated) continue;
    const double at = x[column++];
    row.value = row.coordinate == Coordinate::logarithm ? std::exp(at) : at;
    // exactly at the bound
    if (std::ranges::find(held, column - 1) != held.end()) {
      const bool below = std::abs(row.value - row.lower) <= std::abs(row.upper - row.value);
      row.value = below ? row.lower : row.upper;
    }
    PutIntoModel(row, gravity, fit);
  }
}

/// Puts rows of the law that leave their bounds by no more than their interval to these: what is beyond is noise. report: [p x p + m]; returns their columns
std::vector<Index> HoldBounds(const MatrixXd& report, const Fit& fit, FieldPosterior& posterior) {
  std::vector<Index> held;
  std::vector<double> gaps;
  Index column = -1;
  for (const FitParameter& row : fit.parameters) {
    if (!row.estimated) continue;
    ++column;
    if (!IsNominal(row.role)) continue;
    const double value = report.row(column).dot(posterior.mean);
    const double gap = std::clamp(value, row.lower, row.upper) - value;
    const VectorXd function = report.row(column);
    const double deviation = std::sqrt(function.dot(posterior.covariance * function));
    if (gap == 0 || std::abs(gap) > kNormal95 * deviation) continue;
    held.push_back(column);
    gaps.push_back(gap);
  }
  if (held.empty()) return held;
  const MatrixXd of = report(held, Eigen::all);
  const MatrixXd pull = posterior.covariance * of.transpose();
  posterior.mean += pull * (of * pull).ldlt().solve(VectorXd::Map(gaps.data(), std::ssize(gaps)));
  return held;
}

/// Whether a fit is linear in its unknowns.
bool IsLinear(const Fit& fit) {
  return !fit.friction.thermal && !fit.RowOf(Role::load) && !fit.RowOf(Role::delay);
}

constexpr int kMostRounds = 4;
constexpr double kRests = 0.1;  // deviations; why: such a step changes no interval by a hundredth

/// A fit to what fields leave of the torque, and the fields about it.
struct Round {
  Fit fit;
  FieldRows rows;
  std::vector<FieldBlock> blocks;
  double friction = 0;  // N.m or N
  std::unique_ptr<const FieldEvidence> evidence{};
  FieldHyperparameters best{};
  FieldPosterior posterior{};

  SolvedFields solved() const { return {rows, blocks, *evidence, best, posterior}; }
  /// Whether x of the posterior is that of the fit.
  bool Rests() const {
    const VectorXd x = UnknownsOf(fit);
    const Eigen::ArrayXd deviation = posterior.covariance.diagonal().head(x.size()).cwiseSqrt();
    return ((posterior.mean.head(x.size()) - x).array().abs() <= kRests * deviation).all();
  }
};

/// What a fit knew beforehand: its prior has the noise's variance over that of each unknown, about 0 but for E(0).
void TakePrior(const Fit& fit, double start, FieldRows& rows) {
  const VectorXd& prior = fit.errors.prior;
  if (prior.size() == 0) return;
  const double variance = fit.residual().squaredNorm() / static_cast<double>(fit.torque.size());
  rows.prior_precision = prior / variance;
  rows.prior_mean = VectorXd::Zero(prior.size());
  Index column = 0;
  for (const FitParameter& row : fit.parameters) {
    if (!row.estimated) continue;
    if (row.role == Role::start) rows.prior_mean[column] = start;
    ++column;
  }
}

/// left_out: [N] of the torque, that the fit did not see
std::unique_ptr<Round> Solve(Fit fit, const IdentifierInput& input, const LogSamples& m,
                             const VectorXd& left_out) {
  auto round = std::make_unique<Round>();
  const Law& law = *FindLaw(fit.friction.law);
  round->rows = MakeFieldRows(fit, m, ConstantOf(fit, law, m), left_out);
  TakePrior(fit, InitialEnergyOf(input.options).mean, round->rows);
  round->fit = std::move(fit);
  if (round->rows.size() < kFewestRows) return round;
  round->friction = FrictionOver(round->rows, round->fit);
  round->blocks = MakeFields(Possible(input.options.Get<FieldOption>().fields, round->fit, m),
                             round->rows, m.joint, law);
  round->evidence =
      std::make_unique<const FieldEvidence>(round->rows, round->blocks, round->friction);
  round->best = round->evidence->Maximise();
  round->posterior = round->evidence->At(round->best);
  return round;
}

/// The answer: the fit moved to the posterior, with what fields add to it.
Fit Conclude(const Round& round, const LogSamples& m, const IdentifierInput& input) {
  Fit fit = round.fit;
  SolvedFields solved = round.solved();
  const FieldFigures figures(solved, round.fit, m);
  const std::vector<Index> held = HoldBounds(figures.report(), round.fit, solved.posterior);
  const VectorXd x = UnknownsOf(fit);
  const VectorXd torque = TorqueAlong(fit, m) +
                          fit.jacobian() * (solved.posterior.mean.head(x.size()) - x) +
                          FieldsAlong(solved, x.size(), m);
  fit.torque = Kept(input.measurements.torque, fit.used);
  fit.fitted = Kept(torque, fit.used);
  fit.effective_parameters = round.evidence->EffectiveParameters(round.best);
  const Uncertainty uncertainty = figures.UncertaintyOf(fit.residual(), fit.effective_parameters);
  Take(figures.Reported(), held, fit);
  fit.end_energy = nullptr;
  fit.errors = {};
  fit.errors.covariance = [uncertainty] { return uncertainty; };
  fit.fields = FittedFields{.time_torque = AmplitudeOf(FieldKind::time_torque, solved),
                            .time_friction = DriftOf(solved, round.friction)};
  for (const FieldBlock& block : round.blocks) fit.fields->kinds.push_back(block.kind);
  figures.AddTo(uncertainty.degrees_of_freedom, fit);
  fit.fields->rest = torque - TorqueAlong(fit, m);
  fit.count += static_cast<int>(round.evidence->size() - x.size());
  fit.summary += SummaryOfFields(figures.Shares(round.friction));
  return fit;
}

}  // namespace

FieldSet FieldSet::All() {
  FieldSet all;
  for (const Word<FieldKind>& word : WordsOf(FieldKind{})) all.kinds.push_back(word.value);
  return all;
}

void ReadValue(const Node& node, FieldSet* value, const FieldInfo&) {
  const std::string text = node.Text();
  *value = {};
  if (text == "none") return;
  if (text == "auto") {
    *value = FieldSet::All();
    return;
  }
  // one more comma, so that nothing after the last is a letter as well
  std::istringstream letters(text + ",");
  for (std::string letter; std::getline(letters, letter, ',');) {
    const auto words = WordsOf(FieldKind{});
    const auto word = std::ranges::find(words, letter, &Word<FieldKind>::name);
    if (word == words.end() || std::ranges::find(value->kinds, word->value) != value->kinds.end()) {
      node.RefuseValue("auto, none, or some of q,r,v,d,t with commas between them, each once");
    }
    value->kinds.push_back(word->value);
  }
}

Tree WriteValue(const FieldSet& value) {
  if (value.kinds.empty()) return "none";
  if (value == FieldSet::All()) return "auto";
  std::string text;
  for (const FieldKind kind : value.kinds)
    text += (text.empty() ? "" : ",") + std::string(NameOf(kind));
  return text;
}

Fit FitWithFields(const IdentifierInput& input, const MakeFit& make) {
  const auto* option = input.options.Find<FieldOption>();
  Fit fit = make(input);
  if (fit.refusal || !option || option->fields.kinds.empty()) return fit;
  if (auto why = WhyNone(fit)) {
    if (!why->empty()) fit.causes.push_back(Note(*why));
    return fit;
  }
  const auto motion_of = [&](const Fit& of) {
    auto followed = Followed(input.measurements, of.used, PartsOf(of));
    return followed ? *std::move(followed) : LogView{input.measurements, input.selection};
  };
  LogView followed = motion_of(fit);
  const VectorXd nothing = VectorXd::Zero(input.measurements.size());
  auto round = Solve(std::move(fit), input, followed.measurements, nothing);
  if (!round->evidence) {
    Fit plain = std::move(round->fit);
    plain.causes.push_back(Note(ExplainFewFieldRows(round->rows.size(), kFewestRows)));
    return plain;
  }

  // the fit once more to what the fields leave, and the fields about that
  for (int i = 1; i < kMostRounds && !IsLinear(round->fit) && !round->Rests(); ++i) {
    const VectorXd held =
        FieldsAlong(round->solved(), UnknownsOf(round->fit).size(), followed.measurements);
    LogView less{input.measurements, input.selection};
    less.measurements.torque -= held;
    Fit next = make(input.On(less));
    if (next.refusal || WhyNone(next) || next.parameters.size() != round->fit.parameters.size())
      break;
    followed = motion_of(next);
    auto other = Solve(std::move(next), input, followed.measurements, held);
    if (!other->evidence) break;
    round = std::move(other);
  }
  round->posterior = round->evidence->Averaged(round->best);
  return Conclude(*round, followed.measurements, input);
}

}  // namespace warmjoint

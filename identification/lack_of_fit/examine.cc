#include "identification/lack_of_fit/examine.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "identification/fit/fit_data.h"
#include "identification/lack_of_fit/assumptions.h"
#include "identification/lack_of_fit/fitted_model.h"
#include "identification/lack_of_fit/rounding.h"
#include "identification/lack_of_fit/significance.h"
#include "identification/lack_of_fit/table.h"
#include "identification/linear/rigid_part.h"
#include "identification/sentences/findings.h"
#include "identification/sentences/lack_of_fit.h"
#include "identification/uncertainty/tails.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kFewestBins = 40;  // with fewer bins no structure can be tested
constexpr Index kRowsAColumn = 3;
constexpr double kWorstTenth =
    3.1622776601683795;  // why: sqrt(10), a tenth of the log may hold all squares of an effect
constexpr double kRange =
    3.5;                     // why: sqrt(12), from least to most of what rises evenly, over its rms
constexpr int kRounds = 12;  // why: halves what is left of a bias in each, to 1 in 4000

/// The tests that have not rejected yet, with their features relative to the present fit.
struct Candidates {
  std::vector<Finding*> findings;
  std::vector<Features> features;

  size_t size() const { return findings.size(); }
  void Remove(size_t i) {
    const auto at = static_cast<std::ptrdiff_t>(i);
    findings.erase(findings.begin() + at);
    features.erase(features.begin() + at);
  }
};

/// The tests for which there are enough rows; the findings of the others say why they were not made.
Candidates WithEnoughRows(const std::vector<Finding*>& findings, const Bins& bins,
                          const Circumstances& circumstances, const GrowingFit& fit,
                          Index columns) {
  Candidates candidates;
  for (Finding* const finding : findings) {
    Features features = finding->test->features(bins, circumstances, fit);
    const Index more = features.columns.cols();
    if (more == 0) {
      if (!features.absent.empty()) finding->reason = features.absent;
      continue;
    }
    if (kRowsAColumn * (columns + more) > bins.size()) {
      finding->reason = ExplainFewRowsOfTest(bins.size());
      continue;
    }
    columns += more;
    candidates.findings.push_back(finding);
    candidates.features.push_back(std::move(features));
  }
  return candidates;
}

/// Enters what a test found; a test that was not made leaves its row as it is.
void Record(std::optional<Finding> made, Finding& row) {
  if (!made) return;
  made->test = row.test;
  row = std::move(*made);
}

/// The rows of the table that belong to one stage.
std::vector<Finding*> RowsOf(Stage stage, std::vector<Finding>& table) {
  std::vector<Finding*> rows;
  for (Finding& finding : table) {
    if (finding.test->stage == stage && !finding.is_held) rows.push_back(&finding);
  }
  return rows;
}

/// Makes the tests over bins of one stage one after the other: of those that reject, the features of the largest gain join the
/// fit, and the other tests are made again relative to that fit, until none rejects. Where there are too few rows for all
/// features, the last tests are left out: two rows in three remain to estimate the noise.
/// begin: the fit by mean dF/dx; rest: [N] what is left of tau - F, N.m or N; what the features of the tests that reject and
/// the parameters explain is subtracted from it.
void TestStage(Stage stage, const Bins& bins, const WeighedFit& begin,
               const Circumstances& circumstances, Eigen::VectorXd& rest, ErrorLevel& level,
               std::vector<Finding>& table) {
  GrowingFit fit(begin, bins.Means(rest), AllOf(bins.size()));
  Candidates candidates =
      WithEnoughRows(RowsOf(stage, table), bins, circumstances, fit, begin.norms.size());
  fit.LearnNoise(candidates.features);

  while (candidates.size() > 0) {
    // the test that rejects with the largest gain
    size_t best = candidates.size();
    for (size_t i = 0; i < candidates.size(); ++i) {
      Finding made = fit.Test(candidates.features[i]);
      if (!made.made) made.reason = kHeldByTheFit;
      const bool rejects = level.WouldReject(made);
      Record(std::move(made), *candidates.findings[i]);
      if (!rejects) continue;
      if (best == candidates.size() ||
          candidates.findings[i]->gain > candidates.findings[best]->gain) {
        best = i;
      }
    }
    if (best == candidates.size()) break;

    // joins the fit; scans look for their best candidate relative to the fit with it
    level.Rejects(*candidates.findings[best]);
    fit.Take(candidates.features[best]);
    candidates.Remove(best);
    for (size_t i = 0; i < candidates.size(); ++i) {
      if (candidates.features[i].candidates == 1) continue;
      candidates.features[i] = candidates.findings[i]->test->features(bins, circumstances, fit);
    }
  }
  bins.TakeOff(fit.Explained(), rest);
}

bool IsFinite(const FittedModel& model) {
  return model.residual.allFinite() && model.derivatives.allFinite();
}

/// Why nothing can be examined; empty where it can.
std::string Obstacle(const std::optional<FittedModel>& model, const Bins& bins) {
  if (!model) return kFitGivesNoFriction;
  if (!IsFinite(*model)) return kResidualIsNotFinite;
  if (IsRounding(Kept(model->residual, model->selection).squaredNorm(),
                 Kept(model->torque, model->selection))) {
    return kFitIsExact;
  }
  if (bins.size() < kFewestBins) {
    return ExplainFewRows(bins.size());
  }
  return "";
}

/// Of the parameters, of the jumps at gaps, and of heat within the steps where that matters, over
/// bins. [m x (p + ...)]
Eigen::MatrixXd DerivativesOver(const Bins& bins, const FittedModel& model) {
  const Eigen::MatrixXd derivatives = bins.Means(model.derivatives);
  return model.held_loss ? ConcatColumns(derivatives, bins.Means(*model.held_loss)) : derivatives;
}

/// The tests of structure that changes within segments and recurs in each. A bristle's force
/// depends on the distance since the last reversal by itself, and the log does not show by how much it changes between
/// two samples. So of a law with a bristle nothing more can be said. rest: [N]
void TestWithin(const OverBins& over, Eigen::VectorXd& rest, ErrorLevel& level,
                std::vector<Finding>& table) {
  using enum Stage;
  const auto& [model, m, bins, derivatives, fit, circumstances] = over;
  if (model.has_bristle) {
    for (Finding& finding : table) {
      if (finding.test->stage != first) {
        finding.reason = kBristleFollowsDistance;
      }
    }
    return;
  }

  // samples first: they show structure that is too fine for bins
  for (const Stage stage :
       {fading, lag, motor_angle, motor_angle_by_speed, position, position_by_speed}) {
    for (Finding* const row : RowsOf(stage, table)) {
      Record(row->test->at_samples(*row->test, model, m, rest, level), *row);
    }
  }

  // then structure that recurs with every hold, and last structure that is periodic in time
  const Bins within = BinsWithinHolds(m, model.selection);
  const WeighedFit fit_within(within.weight, DerivativesOver(within, model));
  TestStage(hold, within, fit_within, circumstances, rest, level, table);
  TestStage(last, bins, fit, circumstances, rest, level, table);
}

/// How much changes of a fit's parameters change the friction of law and heat.
class FrictionChange {
 public:
  /// friction: rms of law and heat over the kept samples, N.m or N.
  FrictionChange(const OverBins& over, double friction)
      : root_(over.fit.root / (friction * std::sqrt(over.bins.weight.sum()))),
        warm_(over.derivatives.leftCols(over.model.of_friction)),
        cold_(over.bins.Means(over.model.cold)),
        has_heat_(over.model.thermal.has_value()) {}

  /// Whether a warming was fitted, which may have taken up a part of what was found.
  bool HasHeat() const { return has_heat_; }

  /// The largest of three, rms over the kept samples as a share of the friction's: the change along
  /// the log J d, that of the cold curve dFn/dp d, and that of the heat's part, the
  /// difference of both. d: [p]
  double By(const Eigen::VectorXd& changes) const {
    const Eigen::VectorXd along = warm_ * changes.head(warm_.cols());
    const Eigen::VectorXd cold = cold_ * changes.head(cold_.cols());
    const auto share = [&](const Eigen::VectorXd& force) {
      return root_.cwiseProduct(force).norm();
    };
    return std::max({share(along), share(cold), share(along - cold)});
  }

 private:
  Eigen::VectorXd root_;  // [m] of the weights, over the friction's rms and the root of the samples
  Eigen::MatrixXd warm_;  // [m x q] dF/dx by law, heat and start
  Eigen::MatrixXd cold_;  // [m x d] dFn/dp
  bool has_heat_;
};

/// How much a finding changes the friction, by the measure in its test's row of the table.
double HarmOf(const Finding& finding, const FrictionChange& change,
              const Examination& examination) {
  const double effect = examination.Rms(finding) / examination.friction;
  if (finding.moves.size() == 0) return effect;
  const double moved = change.By(finding.moves);
  switch (finding.test->harm) {
    case Impact::of_moves:
      return moved;
    case Impact::of_either:
      return std::max(effect, moved);
    case Impact::of_drift:
      return change.HasHeat() ? moved : std::min(moved, kWorstTenth * effect);
    case Impact::of_effect:
    case Impact::of_effect_twice:
    case Impact::of_direction:
      break;
  }
  return effect;
}

/// Share of the friction by which it may differ at any of its samples for what a finding explains: sqrt(10) times the effect, which
/// the effect may be in the worst tenth of the log; infinite for those that count by the biases of the parameters.
double MostChange(const Finding& finding, const FrictionChange& change,
                  const Examination& examination) {
  const Impact harm = finding.test->harm;
  const bool by_moves = harm == Impact::of_moves || harm == Impact::of_either ||
                        (harm == Impact::of_drift && change.HasHeat());
  return by_moves ? kInfinity : kWorstTenth * examination.Rms(finding) / examination.friction;
}

/// How much of the biases by a finding is possible: where biases of parameters together change the friction by more than what
/// was found, they partly cancel.
struct BoundedMoves {
  double most = 0;   // of the friction by which it changes, as a share
  double share = 1;  // of the biases
};

BoundedMoves Bounded(const Finding& finding, const FrictionChange& change,
                     const Examination& examination) {
  double variance = 0;
  for (const auto& column : finding.move_spread.colwise()) {
    variance += std::pow(change.By(column), 2);
  }
  const double reach = change.By(finding.moves) + kNormal95 * std::sqrt(variance);
  const double most = std::min(reach, MostChange(finding, change, examination));
  return {most, reach > 0 ? most / reach : 1};
}

/// Sums up how what was found biases the parameters, and how much that changes the friction. The parameters get the whole bias,
/// since where two biases cancel in the friction both parameters still have theirs. The friction changes by no more than was found.
void SumBiases(const OverBins& over, Examination& examination) {
  if (examination.Found().empty()) return;
  const FrictionChange change(over, examination.friction);
  double drifts = 0;  // share of the friction
  for (Finding& finding : examination.findings) {
    if (!finding.rejected) continue;
    finding.harm = HarmOf(finding, change, examination);
    if (finding.test->harm != Impact::of_drift) continue;
    drifts = std::hypot(drifts, MostChange(finding, change, examination));
  }
  // where the law has no heat, what is open of a drift changes the friction by no more than what was found of it may; with heat
  // that has no limit, since the warming may have taken up the rest
  for (Cause& open : examination.causes) {
    if (open.source != Source::open_drift || drifts == 0) continue;
    open.bias *= std::min(1.0, drifts / change.By(open.bias));
  }
  const Index p = std::ssize(examination.rows);
  for (const About about : {About::parameters, About::friction}) {
    VectorXd bias = VectorXd::Zero(p);
    // findings count as independent of each other: their covariances add up
    Eigen::MatrixXd spread(p, 0);
    for (const Finding& finding : examination.findings) {
      if (!finding.rejected || finding.moves.size() == 0) continue;
      const double share =
          about == About::friction ? Bounded(finding, change, examination).share : 1;
      bias += share * finding.moves.head(p);
      spread = ConcatColumns(spread, share * finding.move_spread.topRows(p));
    }
    examination.Add(Source::findings, Action::widen, std::move(bias));
    examination.causes.back().about = about;
    examination.causes.back().spread = std::move(spread);
  }
}

/// The biases of parameters by findings before adjustment, as far as they change the friction. Two findings may be one and the
/// same thing seen twice, so each has a row. A parameter's bias counts up to what changes the friction by as much as the
/// finding does: the bias beyond that is cancelled by that of another parameter.
void AddUnadjusted(const OverBins& over, Examination& examination) {
  const std::vector<const Finding*> found = examination.FoundUnadjusted();
  if (found.empty()) return;
  const Index p = std::ssize(examination.rows), q = over.derivatives.cols();
  const FrictionChange change(over, examination.friction);
  VectorXd own(p);  // of the friction, by a change of each parameter by 1
  for (Index i = 0; i < p; ++i) own[i] = change.By(VectorXd::Unit(q, i));
  for (const Finding* one : found) {
    const auto [most, share] = Bounded(*one, change, examination);
    examination.Add(Source::unadjusted_findings, Action::widen, share * one->moves);
    examination.causes.back().spread = share * one->move_spread.topRows(p);
    examination.causes.back().most = (own.array() > 0).select(most / own.array(), kInfinity);
  }
}

/// A disturbance that recurs with every hold and vanishes somewhere in it has a mean over the hold that is no farther from 0
/// than its values are from each other. The mean looks like friction, or like an offset. Where the two directions
/// differ, either may be the undisturbed one, and each differs from their mean by as much.
void AddHiddenMeans(const Bins& bins, const WeighedFit& fit, Examination& examination) {
  // the range of all disturbances that recur with the holds
  double range = 0;
  for (const Finding& finding : examination.findings) {
    if (!finding.rejected) continue;
    if (finding.test->stage == Stage::hold) range += kRange * examination.Rms(finding);
    if (finding.test->harm == Impact::of_direction) range += examination.Rms(finding);
  }
  if (range == 0) return;

  // such a mean acts against the motion, as friction, or in one direction, as an offset
  Eigen::MatrixXd means(bins.size(), 2);
  means << bins.velocity.array().sign().matrix(), Eigen::VectorXd::Ones(bins.size());
  examination.Add(Source::hidden_means, Action::widen,
                  fit.BiasBy(range * means).cwiseAbs().rowwise().sum());
}

/// Adds a row for how much steps of the torque that hide it bias the parameters: the error may be anything within half a step, so
/// that the worst is taken at each bin.
void AddHiddenSteps(const RoundedTorque& rounded, const WeighedFit& fit, Examination& examination) {
  if (!rounded.IsHidden()) return;
  examination.Add(Source::hidden_steps, Action::widen, rounded.step() / 2 * fit.MostMoves());
}

/// Adds the row of a torque whose steps noise evens out in part, and returns their mean error, [N]. The fit holds a part of the error, so
/// that the torque that was rounded follows from the parameters without their biases.
VectorXd AddRounding(const OverBins& over, Examination& examination) {
  const auto& [model, m, bins, derivatives, fit, circumstances] = over;
  const Index q = model.derivatives.cols();
  VectorXd shift = VectorXd::Zero(fit.norms.size()), error;
  for (int i = 0; i < kRounds; ++i) {
    const VectorXd residual = model.residual - model.derivatives * shift.head(q);
    error = RoundedTorque(m.torque, residual, model.selection).MeanError();
    // half of the shift: the error may change by more than the torque does
    shift = (shift + fit.BiasBy(bins.Means(error)).col(0)) / 2;
  }
  examination.Add(Source::rounding, Action::shift, std::move(shift));
  return error;
}

/// Subtracts what the steps of the torque leave in the residual. rest: [N]
void TakeOffRounding(const OverBins& over, const RoundedTorque& rounded, VectorXd& rest,
                     Examination& examination) {
  if (rounded.IsHidden()) {
    const double most = rounded.step() / 2;
    rest -= rest.cwiseMin(most).cwiseMax(-most);
  } else if (!rounded.IsEven()) {
    rest -= AddRounding(over, examination);
  }
}

/// Marks the tests of what fields hold.
void LeaveToFields(const Fit& fit, std::vector<Finding>& table) {
  for (Finding& finding : table) {
    const std::optional<FieldKind>& field = finding.test->in_field;
    if (!field || !HasField(fit, *field)) continue;
    finding.is_held = true;
    finding.reason = kHeldByField;
  }
}

/// Computes the friction that effects are compared with: that of law and heat, without maps, which may hold gravity.
void Measure(const FittedModel& model, const Bins& bins, Examination& examination) {
  examination.rows = model.rows;
  examination.samples = bins.weight.sum();
  Eigen::VectorXd friction = model.torque - model.residual;
  if (model.maps) friction -= *model.maps;
  examination.friction =
      std::sqrt(Kept(friction, model.selection).squaredNorm() / examination.samples);
  examination.squares = Kept(model.residual, model.selection).squaredNorm();
}

}  // namespace

void Examination::Add(Source source, Action action, Eigen::VectorXd bias, double size) {
  bias.conservativeResize(std::ssize(rows));
  causes.push_back(
      {.source = source, .action = action, .rows = rows, .bias = std::move(bias), .size = size});
}

double Examination::Rms(const Finding& finding) const {
  return std::sqrt(std::min(finding.explained, squares) / samples);
}

std::vector<const Finding*> Examination::Found() const {
  std::vector<const Finding*> found;
  for (const Finding& finding : findings) {
    if (finding.rejected) found.push_back(&finding);
  }
  std::ranges::stable_sort(found, std::greater(), &Finding::explained);
  return found;
}

std::vector<const Finding*> Examination::FoundUnadjusted() const {
  std::vector<const Finding*> found;
  for (const Finding& finding : findings) {
    const bool unadjusted = finding.made && !finding.rejected && finding.p <= kErrorLevel;
    if (unadjusted && finding.moves.size() > 0) found.push_back(&finding);
  }
  return found;
}

std::vector<Finding> NotMade(const std::string& reason) {
  std::vector<Finding> table;
  for (const LackOfFitTest& test : LackOfFitTests()) {
    Finding& finding = table.emplace_back();
    finding.test = &test;
    finding.reason = reason.empty() ? test.words.absent : reason;
  }
  return table;
}

Examination ExamineResidual(const std::optional<FittedModel>& model, const Fit& fit,
                            const Inference& by_noise, const LogSamples& m) {
  // the fit along the log, and a reason why it cannot be examined, if there is one
  Examination examination;
  const Bins bins = model ? MakeBins(m, model->selection) : Bins{};
  const std::string obstacle = Obstacle(model, bins);
  examination.findings = NotMade(obstacle);
  LeaveToFields(fit, examination.findings);
  if (!model || !IsFinite(*model) || bins.size() == 0) return examination;

  // what parameters can explain; an exact fit may be one to a few steps of the torque
  Measure(*model, bins, examination);
  const Eigen::MatrixXd derivatives = DerivativesOver(bins, *model);
  const WeighedFit fitted(bins.weight, derivatives);
  const RoundedTorque rounded(m.torque, model->residual, model->selection);
  AddHiddenSteps(rounded, fitted, examination);
  if (!obstacle.empty()) return examination;

  // what assumptions can explain, and heat within the steps
  const OverBins over{*model, m, bins, derivatives, fitted, CircumstancesOf(*model, m, bins)};
  AddAssumptions(over, fit, by_noise, examination);

  // first known influences on friction, then structure that changes within segments, then what stays from one to the next
  ErrorLevel level(static_cast<int>(LackOfFitTests().size()));
  Eigen::VectorXd rest = model->residual;
  TakeOffRounding(over, rounded, rest, examination);
  std::vector<Finding>& table = examination.findings;
  TestStage(Stage::first, bins, over.fit, over.circumstances, rest, level, table);
  TestWithin(over, rest, level, table);

  // how all of that biases the parameters
  SumBiases(over, examination);
  AddUnadjusted(over, examination);
  AddHiddenMeans(bins, over.fit, examination);
  return examination;
}

}  // namespace warmjoint

#include "identification/lack_of_fit/examine.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "identification/fit_data.h"
#include "identification/lack_of_fit/fitted_model.h"
#include "identification/lack_of_fit/lag.h"
#include "identification/lack_of_fit/ripple.h"
#include "identification/lack_of_fit/rounding.h"
#include "identification/lack_of_fit/sensitivity.h"
#include "identification/lack_of_fit/significance.h"
#include "identification/lack_of_fit/table.h"
#include "identification/lack_of_fit/undetected_bias.h"
#include "identification/linear/rigid_part.h"
#include "identification/uncertainty/tails.h"

namespace warmjoint {
namespace {

/// What tests over bins found.
struct BinFindings {
  std::vector<Finding> findings;  // one for each test that was asked, in the order of the table
  Eigen::VectorXd explained;      // [m] what those rejected and the parameters take up, N.m or N
};

using Eigen::Index;

constexpr Index kRowsAColumn = 3;

/// The tests that are still open, with their features beside the present fit.
struct Open {
  std::vector<const LackOfFitTest*> tests;
  std::vector<Finding*> findings;
  std::vector<Features> features;

  size_t size() const { return tests.size(); }
  void Close(size_t i) {
    const auto at = static_cast<std::ptrdiff_t>(i);
    tests.erase(tests.begin() + at);
    findings.erase(findings.begin() + at);
    features.erase(features.begin() + at);
  }
};

/// The tests that there are rows for; the others say why not.
Open Affordable(const std::vector<const LackOfFitTest*>& tests, const Bins& bins,
                const Circumstances& known, const GrowingFit& fit, Index columns,
                std::vector<Finding>& findings) {
  Open open;
  for (size_t i = 0; i < tests.size(); ++i) {
    findings[i].test = tests[i];
    Features features = tests[i]->features(bins, known, fit);
    const Index more = features.columns.cols();
    if (more == 0) {
      findings[i].reason = tests[i]->absent;
    } else if (kRowsAColumn * (columns + more) > bins.size()) {
      findings[i].reason = fmt::format("{} samples or segments are too few for it", bins.size());
    } else {
      columns += more;
      open.tests.push_back(tests[i]);
      open.findings.push_back(&findings[i]);
      open.features.push_back(std::move(features));
    }
  }
  return open;
}

/// Makes a test beside the present fit.
void Make(const Open& open, size_t i, const GrowingFit& fit, const ErrorLevel& level) {
  Finding made = fit.Test(open.features[i]);
  made.test = open.tests[i];
  if (!made.made) made.reason = kHeldByTheFit;
  made.p_adjusted = level.Adjusted(made.p);
  *open.findings[i] = std::move(made);
}

/// Makes tests one after the other: of those that reject, the features of the largest gain join the
/// fit, and the others are made again beside it, until none rejects. Too few rows for all features
/// leave the last tests out: two rows in three are left to tell the noise.
/// tests: rows of the table with features; residual: [m] mean tau - F of each bin; derivatives:
/// [m x p] mean dF/dx.
BinFindings TestBins(const std::vector<const LackOfFitTest*>& tests, const Bins& bins,
                     const Eigen::VectorXd& residual, const Eigen::MatrixXd& derivatives,
                     const Circumstances& known, ErrorLevel& level) {
  const Selection all{Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(bins.size(), true), {}};
  GrowingFit fit(bins.weight, residual, derivatives, all);
  BinFindings result;
  result.findings.resize(tests.size());
  Open open = Affordable(tests, bins, known, fit, derivatives.cols(), result.findings);
  fit.LearnNoise(open.features);

  while (open.size() > 0) {
    // the test that rejects with the largest gain
    size_t best = open.size();
    for (size_t i = 0; i < open.size(); ++i) {
      Make(open, i, fit, level);
      const Finding& made = *open.findings[i];
      if (!level.WouldReject(made.p) || made.explained <= 0) continue;
      if (best == open.size() || made.gain > open.findings[best]->gain) best = i;
    }
    if (best == open.size()) break;

    // joins the fit; scans look for their best candidate beside it
    open.findings[best]->rejected = level.Rejects(open.findings[best]->p);
    fit.Take(open.features[best]);
    open.Close(best);
    for (size_t i = 0; i < open.size(); ++i) {
      if (open.features[i].candidates == 1) continue;
      open.features[i] = open.tests[i]->features(bins, known, fit);
    }
  }
  result.explained = fit.Explained();
  return result;
}

/// Whether what the maps give goes with the energy, beside maps whose strength is free.
/// residual: [N] tau - F; what is found is taken off it.
Finding TestFading(const FittedModel& model, Eigen::VectorXd& residual, ErrorLevel& level) {
  Finding finding;
  finding.test = FindLackOfFitTest("position_by_energy");
  finding.reason = finding.test->absent;
  if (!model.maps || !model.thermal) return finding;

  // beside maps whose strength is free
  const Selection& selection = model.selection;
  const Eigen::MatrixXd maps = Kept(*model.maps, selection);
  const Eigen::MatrixXd left = Kept(residual, selection);
  const Features steady{maps}, fading{maps.cwiseProduct(Kept(model.energy, selection))};
  GrowingFit fit(Eigen::VectorXd::Ones(left.rows()), left, Kept(model.derivatives, selection),
                 selection);
  fit.LearnNoise({steady, fading});
  fit.Take(steady);
  finding = fit.Test(fading);
  finding.test = FindLackOfFitTest("position_by_energy");
  finding.p_adjusted = level.Adjusted(finding.p);
  if (finding.explained <= 0 || !level.Rejects(finding.p)) return finding;

  // taken off the residual
  finding.rejected = true;
  fit.Take(fading);
  const Eigen::VectorXd explained = fit.Explained();
  Eigen::Index row = 0;
  for (Eigen::Index i = 0; i < residual.size(); ++i) {
    if (selection.keep[i]) residual[i] -= explained[row++];
  }
  return finding;
}

using Eigen::Index;

constexpr Index kFewestBins = 40;  // below, nothing can be said of structure
constexpr double kRange =
    3.5;  // why: sqrt(12), from least to most of what rises evenly, over its rms

/// The rows of the table that look at bins in one turn.
std::vector<const LackOfFitTest*> Rows(Turn turn) {
  std::vector<const LackOfFitTest*> rows;
  for (const LackOfFitTest& test : LackOfFitTests()) {
    if (test.turn == turn && test.features) rows.push_back(&test);
  }
  return rows;
}

/// Why nothing can be examined; empty where it can.
std::string Obstacle(const std::optional<FittedModel>& model, const Bins& bins) {
  if (!model) return "the fit gives no friction";
  if (!model->residual.allFinite() || !model->derivatives.allFinite()) {
    return "the residual is not finite";
  }
  if (IsRounding(Kept(model->residual, model->selection).squaredNorm(),
                 Kept(model->torque, model->selection))) {
    return "the fit is exact: the residual is the rounding of its numbers";
  }
  if (bins.size() < kFewestBins) {
    return std::to_string(bins.size()) + " samples or segments are too few to examine";
  }
  return "";
}

/// Puts findings where the table has their rows.
void Enter(std::vector<Finding> some, std::vector<Finding>& table) {
  for (Finding& one : some) {
    const auto row = std::ranges::find(table, one.test, &Finding::test);
    *row = std::move(one);
  }
}

/// The tests over bins in one turn, on what is left; takes off what they find. rest: [N]
void TestInTurn(Turn turn, const Bins& bins, const Eigen::MatrixXd& derivatives,
                const Circumstances& known, Eigen::VectorXd& rest, ErrorLevel& level,
                std::vector<Finding>& table) {
  BinFindings made = TestBins(Rows(turn), bins, bins.Means(rest), derivatives, known, level);
  // what they found is taken off all samples of a bin alike
  for (Index c = 0; c < bins.size(); ++c) {
    const auto i = static_cast<size_t>(c);
    for (Index n = bins.begin[i]; n < bins.end[i]; ++n) rest[n] -= made.explained[c];
  }
  Enter(std::move(made.findings), table);
}

/// The tests of what changes within segments and stays from one to the next. A bristle's force
/// depends on the way since the last reversal by itself, and by how much between two samples the log
/// does not tell: of a law that has one nothing more can be said. rest: [N]
void TestWithin(const FittedModel& model, const LogSamples& m, const Bins& bins,
                const Eigen::MatrixXd& derivatives, const Circumstances& known,
                Eigen::VectorXd& rest, ErrorLevel& level, std::vector<Finding>& table) {
  if (model.has_bristle) {
    for (Finding& finding : table) {
      if (finding.test->turn != Turn::first) {
        finding.reason = "the law has a bristle, whose force follows the way by itself";
      }
    }
    return;
  }

  // samples first: they show what is too fine for bins
  Enter({TestFading(model, rest, level)}, table);
  Enter({TestLag(model, m, rest, level)}, table);
  Enter(TestRipple(model, m, rest, level), table);

  // then what returns with every hold, and last what is periodic in time
  const Bins within = BinsWithinHolds(m, model.selection);
  TestInTurn(Turn::hold, within, DerivativesOver(within, model), known, rest, level, table);
  TestInTurn(Turn::last, bins, derivatives, known, rest, level, table);
}

/// How far a finding changes the friction, as the row of its test has it.
double HarmOf(const Finding& finding, const FrictionChange& change,
              const Examination& examination) {
  const double effect = examination.Rms(finding) / examination.friction;
  const Harm harm = finding.test->harm;
  const bool by_size = harm == Harm::of_effect || harm == Harm::of_direction;
  if (by_size || finding.moves.size() == 0) return effect;
  const double moved = change.By(finding.moves);
  if (harm == Harm::of_moves) return moved;
  return std::max(effect, moved);
}

/// Sums up how what was found moves the parameters, and how far that changes the friction.
void SumMoves(const FittedModel& model, const Bins& bins, const Eigen::MatrixXd& derivatives,
              Index p, Examination& examination) {
  if (examination.Found().empty()) return;
  Eigen::VectorXd bias = Eigen::VectorXd::Zero(p);
  // findings count as independent of each other: their variances add up
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(p);
  for (const Finding& finding : examination.findings) {
    if (!finding.rejected || finding.moves.size() == 0) continue;
    bias += finding.moves.head(p);
    variance += finding.move_deviations.head(p).cwiseAbs2();
  }
  examination.Add(Source::findings, Action::widen, std::move(bias));
  examination.causes.back().spread = variance.cwiseSqrt();

  const FrictionChange change(model, bins, derivatives, examination.friction);
  for (Finding& finding : examination.findings) {
    if (finding.rejected) finding.harm = HarmOf(finding, change, examination);
  }
}

/// What hints move parameters by, with 95 % of it. They may be one and the same thing seen twice: the largest of them
/// counts.
void AddHints(Index p, Examination& examination) {
  const std::vector<const Finding*> hints = examination.Hints();
  if (hints.empty()) return;
  Eigen::VectorXd most = Eigen::VectorXd::Zero(p);
  for (const Finding* hint : hints) {
    most =
        most.cwiseMax(hint->moves.head(p).cwiseAbs() + kNormal95 * hint->move_deviations.head(p));
  }
  examination.Add(Source::hints, Action::widen, std::move(most));
}

/// What returns with every hold and vanishes somewhere in it has a mean over the hold that is no farther from 0
/// than its values are from each other. The mean looks like friction, or like an offset. Of two directions that
/// differ either may be the one without what disturbs, by as much as their mean is off.
void AddHiddenMeans(const Bins& bins, const ForceMoves& moves, Index p, Examination& examination) {
  // how far apart the values lie of all that returns with the holds
  double range = 0;
  for (const Finding& finding : examination.findings) {
    if (!finding.rejected) continue;
    if (finding.test->turn == Turn::hold) range += kRange * examination.Rms(finding);
    if (finding.test->harm == Harm::of_direction) range += examination.Rms(finding);
  }
  if (range == 0) return;

  // such a mean acts against the motion, as friction, or in one direction, as an offset
  Eigen::MatrixXd means(bins.size(), 2);
  means << bins.velocity.array().sign().matrix(), Eigen::VectorXd::Ones(bins.size());
  examination.Add(Source::hidden_means, Action::widen,
                  moves.By(range * means).topRows(p).cwiseAbs().rowwise().sum());
}

/// Takes off what the steps of the torque leave in the residual, and learns how they move the parameters. rest: [N]
void TakeOffRounding(const FittedModel& model, const LogSamples& m, const Bins& bins,
                     const ForceMoves& moves, Index p, Eigen::VectorXd& rest,
                     Examination& examination) {
  const double variance = examination.squares / examination.samples;
  if (const double step = HidingStep(m.torque, variance); step > 0) {
    // any error within half a step, at each bin the worst
    rest -= rest.cwiseMin(step / 2).cwiseMax(-step / 2);
    const Eigen::MatrixXd each = Eigen::MatrixXd::Identity(bins.size(), bins.size());
    examination.Add(Source::hidden_steps, Action::widen,
                    step / 2 * moves.By(each).topRows(p).cwiseAbs().rowwise().sum());
    return;
  }
  const Eigen::VectorXd rounding = MeanRounding(m.torque, model.residual, variance);
  if (rounding.size() == 0) return;
  rest -= rounding;
  examination.Add(Source::rounding, Action::shift, moves.By(bins.Means(rounding)).topRows(p));
}

/// What sizes are measured by: the friction of law and heat, without what a map may hold of gravity.
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

std::vector<const Finding*> Examination::Hints() const {
  std::vector<const Finding*> hints;
  for (const Finding& finding : findings) {
    const bool hint = finding.made && !finding.rejected && finding.p <= kErrorLevel;
    if (hint && finding.moves.size() > 0) hints.push_back(&finding);
  }
  return hints;
}

std::vector<Finding> NotMade(const std::string& reason) {
  std::vector<Finding> table;
  for (const LackOfFitTest& test : LackOfFitTests()) {
    Finding& finding = table.emplace_back();
    finding.test = &test;
    finding.reason = reason.empty() ? test.absent : reason;
  }
  return table;
}

Examination ExamineResidual(const Fit& fit, const Inference& by_noise, const LogSamples& m,
                            const Selection& selection) {
  // the fit along the log, and why it may not be examined
  Examination examination;
  const std::optional<FittedModel> model = EvaluateModel(fit, by_noise, m, selection);
  const Bins bins = model ? MakeBins(m, model->selection) : Bins{};
  const std::string obstacle = Obstacle(model, bins);
  examination.findings = NotMade(obstacle);
  if (!obstacle.empty()) return examination;

  // what parameters, assumptions and heat within the steps can do
  const Eigen::MatrixXd derivatives = DerivativesOver(bins, *model);
  const Index p = model->derivatives.cols() - model->jump_spread.size();
  Measure(*model, bins, examination);
  AddHeldLosses(*model, bins, p, derivatives, examination);
  const ForceMoves moves(bins, derivatives);
  const Circumstances known = CircumstancesOf(*model, m, bins);
  AddAssumptions(fit, *model, bins, known, p, derivatives, moves, examination);
  AddUndetectedBias(*model, m, bins, known, p, moves, examination);
  AddOtherUnits(fit, by_noise, m.joint, examination);

  // what is known to act on friction, then what changes within segments, then what stays
  ErrorLevel level(static_cast<int>(LackOfFitTests().size()));
  Eigen::VectorXd rest = model->residual;
  TakeOffRounding(*model, m, bins, moves, p, rest, examination);
  std::vector<Finding>& table = examination.findings;
  TestInTurn(Turn::first, bins, derivatives, known, rest, level, table);
  TestWithin(*model, m, bins, derivatives, known, rest, level, table);

  // what all of that does to the parameters
  SumMoves(*model, bins, derivatives, p, examination);
  AddHints(p, examination);
  AddHiddenMeans(bins, moves, p, examination);
  return examination;
}

}  // namespace warmjoint

#include "identification/identifiers/model_comparison.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "identification/fit/fit_data.h"
#include "identification/forward/log_trajectory.h"
#include "identification/holdout/hold_out.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/identifiers/structures.h"
#include "identification/inference/bounds.h"
#include "identification/linear/linear_laws.h"
#include "identification/parts.h"
#include "identification/sentences/choice.h"
#include "identification/uncertainty/tails.h"
#include "identification/warming/torque_delay.h"
#include "models/friction/laws.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kByChance = 0.05;  // of the logs get a structure; why: as intervals miss the truth

/// Whether the best leaves less than a simpler structure by more than the best of `richer` ones does by chance (ChooseStructure).
bool GainsBeyondChance(const VectorXd& best, const VectorXd& simpler, double richer) {
  const VectorXd apart = simpler - best;
  const Index n = apart.size(), parts = std::min(kParts, n);
  double squares = 0;
  for (Index part = 0; part < parts; ++part) {
    const Index begin = part * n / parts, end = (part + 1) * n / parts;
    const double product = best.segment(begin, end - begin).dot(apart.segment(begin, end - begin));
    squares += product * product;
  }
  const double gain = simpler.squaredNorm() - best.squaredNorm();
  const double quantile =
      StudentQuantile(static_cast<double>(parts - 1), 1 - 2 * kByChance / richer);
  return gain > 2 * quantile * std::sqrt(squares);
}

constexpr Index kBins[] = {8, 16, 32, 64, 128, 256};
constexpr double kDeviations = 2;  // of k F above its mean
constexpr double kTurn = 2 * std::numbers::pi;

/// The place along the travel, from 0 to 1. [n]
VectorXd ShareOfRange(const VectorXd& position) {
  const double lower = position.minCoeff(), range = position.maxCoeff() - lower;
  if (!(range > 0)) return VectorXd::Zero(position.size());
  return (position.array() - lower) / range;
}

/// The place in a turn, from 0 to 1. [n]
VectorXd ShareOfTurn(const VectorXd& angle) {
  return angle.unaryExpr([](double a) { return a / kTurn - std::floor(a / kTurn); });
}

/// Sum and number of the samples in each bin of either direction.
struct Means {
  VectorXd sums, counts;  // [2 bins]

  Means(const VectorXd& residual, const VectorXd& share, const VectorXd& velocity, Index bins)
      : sums(VectorXd::Zero(2 * bins)), counts(VectorXd::Zero(2 * bins)) {
    for (Index i = 0; i < residual.size(); ++i) {
      const auto place = static_cast<Index>(share[i] * static_cast<double>(bins));
      const Index bin = std::min(place, bins - 1) + (velocity[i] > 0 ? bins : 0);
      sums[bin] += residual[i];
      ++counts[bin];
    }
  }

  /// Squares that the means explain.
  double Taken() const { return (sums.array().square() / counts.array().max(1)).sum(); }
  double Filled() const { return static_cast<double>((counts.array() > 0).count()); }
};

bool TakesMoreThanChance(const VectorXd& residual, const VectorXd& share, const VectorXd& velocity,
                         Index bins) {
  const Means means(residual, share, velocity, bins);
  const auto n = static_cast<double>(residual.size());
  // squares about one mean, and about the means of all bins that hold samples
  const double about_mean = residual.squaredNorm() - n * std::pow(residual.mean(), 2);
  const double about_bins = residual.squaredNorm() - means.Taken();
  const double degrees_of_freedom = means.Filled() - 1;
  if (degrees_of_freedom < 1 || !(about_bins > 0) || degrees_of_freedom > 0.5 * n) return false;

  // more than what as many means explain of noise alone
  const double taken = (about_mean - about_bins) / (about_bins / (n - degrees_of_freedom - 1));
  return taken > degrees_of_freedom + kDeviations * std::sqrt(2 * degrees_of_freedom);
}

/// Whether means over bins of place, one set for each direction of motion, take more of a residual
/// than chance would, at any of six widths of 8 to 256 bins:
///     (S0 - S1) / s^2 > k + 2 sqrt(2 k),   s^2 = S1 / (n - k - 1),
/// S0: squares about one mean, S1: squares about the k + 1 means of bins that hold samples. Under chance
/// alone the left side is k F, k on average, with a standard deviation of sqrt(2 k). Kernels are no more flexible than such
/// means, and a map that explains no more than chance does not lower the error on unseen samples.
/// residual: [n] N.m or N; points: [n x 5]. Places are the joint's position, and the motor's angle.
bool LeavesOverPlace(const VectorXd& residual, const MapPoints& points) {
  const auto column = [&](MapQuantity quantity) -> VectorXd {
    return points.col(static_cast<Index>(quantity));
  };
  const VectorXd velocity = column(MapQuantity::velocity);
  const VectorXd shares[] = {ShareOfRange(column(MapQuantity::position)),
                             ShareOfTurn(column(MapQuantity::motor_position))};
  for (const VectorXd& share : shares) {
    for (const Index bins : kBins) {
      if (TakesMoreThanChance(residual, share, velocity, bins)) return true;
    }
  }
  return false;
}

constexpr Eigen::Index kRows = 3000;    // on which structures are compared
constexpr double kHopeless = 4;         // of the mean squared error of another
constexpr double kFewParameters = 0.1;  // of the rows

Trial Try(const Structure& structure, const IdentifierInput& input) {
  Trial trial{structure, structure.Quick().Fitted(input)};
  trial.gives_friction = GivesFriction(trial.fit);
  // the shape that was chosen for a map stays with the structure
  if (!trial.fit.model.friction.maps.empty()) {
    trial.structure = structure.WithShapeOf(trial.fit.model.friction.maps[0]);
  }
  if (trial.gives_friction) return trial;

  // beyond doubt or perhaps by chance
  trial.inferred = Infer(trial.fit);
  trial.dropped =
      trial.inferred.status == Status::ok ? kGivesNoFriction : StatusName(trial.inferred.status);
  return trial;
}

}  // namespace

double Bic(double mean_square, double parameters, double samples) {
  return samples * std::log(mean_square) + parameters * std::log(samples);
}

Choice ChooseStructure(const std::vector<StructureCandidate>& contenders) {
  Choice choice;
  // the one of the least error on rows that it has not seen
  for (size_t i = 1; i < contenders.size(); ++i) {
    if (contenders[i].MeanSquare() < contenders[choice.best].MeanSquare()) choice.best = i;
  }

  // of all that are not worse beyond chance, the simplest
  const StructureCandidate& best = contenders[choice.best];
  choice.chosen = choice.best;
  for (size_t i = 0; i < contenders.size(); ++i) {
    const StructureCandidate& one = contenders[i];
    const StructureCandidate& so_far = contenders[choice.chosen];
    // with fewer parameters, or with as many and a smaller error
    const bool simpler =
        one.parameters < so_far.parameters ||
        (one.parameters == so_far.parameters && one.MeanSquare() < so_far.MeanSquare());
    if (!simpler) continue;
    const auto richer = std::ranges::count_if(
        contenders, [&](const auto& other) { return other.parameters > one.parameters; });
    if (!GainsBeyondChance(best.left, one.left, static_cast<double>(richer))) choice.chosen = i;
  }
  return choice;
}

bool ShowsWeight(const IdentifierInput& input) {
  const LogSamples& m = input.measurements;
  if (m.joint != JointKind::rotary || m.position_integrated || !m.position.allFinite())
    return false;
  const Structure with = ColdStructures(FittedGravity::sincos).back();
  const Fit without = ColdStructures(FittedGravity::none).back().Fitted(input);
  const auto unseen = with.UnseenOn(input, CutIntoBlocks(input.selection, AutoOptions{}.blocks));
  if (without.refusal || !unseen) return false;

  // on the rows of both
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const VectorXd left = AmongAll(without.rows.residual(), without.rows.used, none);
  Selection common = input.selection;
  common.keep = common.keep && left.array().isFinite() && unseen->array().isFinite();
  const std::vector<StructureCandidate> both{
      {without.identifier, Kept(left, common), without.rows.effective_parameters},
      {with.Name(), Kept(*unseen, common), without.rows.effective_parameters + 2}};
  if (common.count() == 0 || !(2 * both[1].MeanSquare() < both[0].MeanSquare())) return false;
  return ChooseStructure(both).chosen == 1;
}

ModelComparison::ModelComparison(const IdentifierInput& input, const Selection& selection)
    : log_(Condense({input.measurements, selection}, kRows)),
      quick_(input.On(log_.view)),
      rows_(static_cast<double>(quick_.selection.count())) {}

void ModelComparison::Add(const std::vector<Structure>& structures) {
  for (const Structure& structure : structures) {
    quick_.Tell("trying " + structure.Name());
    trials_.push_back(Try(structure, quick_));
  }
}

void ModelComparison::LeaveOut(const std::vector<Structure>& structures, const std::string& why) {
  for (const Structure& structure : structures) {
    trials_.push_back({.structure = structure, .dropped = why});
    trials_.back().inferred.status = Status::not_identifiable;
  }
}

const Structure* ModelComparison::Best() const {
  const Trial* best = BestTrial();
  return best ? &best->structure : nullptr;
}

std::optional<double> ModelComparison::LagOfBest(const IdentifierInput& all) const {
  const Trial* best = BestTrial();
  if (!best) return std::nullopt;
  all.Tell("looking for a lag of the torque");
  const Fit& fit = best->fit;

  // jumps of E are at rows: back to the samples with which those begin
  ThermalStart start = fit.Start();
  for (EnergyJump& jump : start.jumps) jump.sample = log_.first[static_cast<size_t>(jump.sample)];
  return LagOf(best->structure, {fit.model.friction, fit.model.gravity, fit.model.inertia}, start,
               all);
}

std::optional<double> ModelComparison::DelayOfBest(const IdentifierInput& all) const {
  if (all.view != View::moving) return std::nullopt;
  all.Tell("looking for a delay of the torque");
  const Structure* best = Best();
  if (best && best->CanEstimateDelay()) {
    const Fit fit = best->Fitted(all);
    if (!fit.refusal) return IsLate(fit) ? fit.model.delay : std::nullopt;
  }
  const auto found = FindLateTorque(all);
  return found ? std::optional(found->delay) : std::nullopt;
}

bool ModelComparison::MayHaveMap() const {
  const Trial* best = BestTrial();
  if (!best) return true;
  const LogSamples& m = log_.view.measurements;
  if (m.position_integrated) return KnowsMotorAngle(m);
  const MapPoints points = Kept(PointsOf(m), best->fit.rows.used);
  return LeavesOverPlace(best->fit.rows.residual(), points);
}

ChosenKernels ModelComparison::KernelsGivenBest(FittedGravity gravity) const {
  quick_.Tell("choosing the kernels of maps");
  // E as the best structure so far has it
  const Trial* best = BestTrial();
  Eigen::VectorXd energy;
  if (best) {
    const Fit& fit = best->fit;
    energy = PredictTorque(fit.model, log_.view.measurements, log_.view.selection, fit.Start())
                 .friction.energy;
  }

  // energy-ml has both maps, over position and over the motor's angle
  const auto chosen = [&](WarmMap position) {
    const Options options = FindIdentifier("energy-ml")
                                .options.With(GravityOption{gravity})
                                .With(WarmMapOptions{{}, position});
    return MapGivenEnergy(quick_.With(options), energy);
  };
  ChosenKernels kernels;
  const LogSamples& m = log_.view.measurements;
  if (!m.position_integrated) kernels.position = chosen(WarmMap::map);
  if (KnowsMotorAngle(m)) kernels.motor = chosen(WarmMap::motor);
  return kernels;
}

bool ModelComparison::MayWarm() const {
  return std::ranges::any_of(trials_, [](const Trial& trial) {
    const Identifier& identifier = trial.structure.identifier;
    if (!trial.structure.CanWarm()) return false;
    // where the joint has a slope, a law without one need not converge with warming
    const bool too_poor = identifier.options.Get<LawOption>().law->name == Coulomb::name;
    return too_poor ? trial.gives_friction : trial.inferred.status != Status::not_identifiable;
  });
}

bool ModelComparison::MayWarmWith(FittedGravity gravity) const {
  const Structure* best = Best();
  return MayWarm() || !best || best->gravity() == gravity;
}

bool ModelComparison::MayBendAndWarm(FittedGravity gravity) const {
  return MayWarm() || Find(StribeckStructure(PartFit::none, gravity))->inferred.status !=
                          Status::not_identifiable;
}

bool ModelComparison::MayHaveTwoLevels(PartFit warming, FittedGravity gravity) const {
  const Trial& one = *Find(StribeckStructure(warming, gravity));
  if (one.inferred.status == Status::ok) return Pushes(one.fit);

  // where the curve does not fit: by a linear law, or by two levels without warming
  if (warming == PartFit::none) return Pushes(First().fit);
  const Trial* cold = Find(TwoLevelStribeckStructure(PartFit::none, gravity));
  return cold && cold->inferred.status == Status::ok;
}

void ModelComparison::DropWithoutSlope() {
  for (Trial& trial : trials_) {
    const Trial* sloped = WithSlope(trial);
    if (!sloped || !trial.dropped.empty()) continue;
    trial.dropped = ExplainMissingSlope(sloped->structure.Name());
  }
}

void ModelComparison::DropDominated() {
  // the best by BIC first: whatever is preferred to a trial comes before it
  std::vector<Trial*> order;
  for (Trial& trial : trials_) {
    if (trial.outdone) trial.dropped.clear();
    trial.outdone = false;
    if (trial.dropped.empty()) order.push_back(&trial);
  }
  std::ranges::stable_sort(order, {}, [&](const Trial* one) { return BicOf(*one); });

  // a trial is dropped only in favour of one that is not dropped itself
  std::vector<const Trial*> standing;
  for (Trial* one : order) {
    for (const Trial* other : standing) {
      if (one->dropped.empty()) one->dropped = WhyDominated(*one, *other);
    }
    one->outdone = !one->dropped.empty();
    if (!one->outdone) standing.push_back(one);
  }
}

void ModelComparison::DropBeyondBounds(const Structure& structure) {
  for (Trial& trial : trials_) {
    if (trial.structure.Name() != structure.Name()) continue;
    trial.dropped = kBeyondBoundsOnAll;
    trial.gives_friction = trial.outdone = false;
  }
}

const Structure* ModelComparison::OnlyOne() const {
  const auto stands = [](const Trial& trial) { return trial.dropped.empty(); };
  if (std::ranges::count_if(trials_, stands) != 1) return nullptr;
  return &std::ranges::find_if(trials_, stands)->structure;
}

bool ModelComparison::HoldOut(Trial& trial, const std::vector<Eigen::Index>& bounds) {
  if (trial.unseen) return true;
  quick_.Tell(fmt::format("comparing on {} held-out blocks: {}", bounds.size() - 1,
                          trial.structure.Name()));
  trial.unseen = trial.structure.UnseenOn(quick_, bounds);
  if (trial.unseen) return true;
  trial.dropped = kFailsWithoutBlock;
  return false;
}

std::vector<StructureCandidate> ModelComparison::Compare(int blocks) {
  const std::vector<Eigen::Index> bounds = CutIntoBlocks(quick_.selection, blocks);
  // a trial that fails is preferred to no other: those that were dropped for it return
  const auto fails = [&](Trial& trial) { return trial.dropped.empty() && !HoldOut(trial, bounds); };
  while (std::ranges::any_of(trials_, fails)) DropDominated();

  // the rows that all predict; a paired gravity does not know every place
  standing_.clear();
  Selection common = quick_.selection;
  for (size_t i = 0; i < trials_.size(); ++i) {
    if (!trials_[i].dropped.empty()) continue;
    standing_.push_back(i);
    common.keep = common.keep && trials_[i].unseen->array().isFinite();
  }
  std::vector<StructureCandidate> contenders;
  if (common.count() == 0) return contenders;
  for (const size_t i : standing_) {
    const Trial& trial = trials_[i];
    contenders.push_back({trial.structure.Name(), Kept(*trial.unseen, common), trial.Parameters()});
  }
  return contenders;
}

std::vector<StructureTrial> ModelComparison::Reported() const {
  std::vector<StructureTrial> reported;
  for (const Trial& trial : trials_) {
    StructureTrial& one = reported.emplace_back();
    one.name = trial.structure.Name();
    one.parameters = trial.Parameters();
    one.dropped = trial.dropped;
    if (!trial.unseen) continue;
    const auto finite = trial.unseen->array().isFinite();
    one.rmse = std::sqrt(finite.select(trial.unseen->array().square(), 0).sum() /
                         static_cast<double>(finite.count()));
  }
  return reported;
}

const Trial* ModelComparison::BestTrial() const {
  const Trial* best = nullptr;
  for (const Trial& trial : trials_) {
    if (!trial.gives_friction || WithSlope(trial)) continue;
    if (!best || BicOf(trial) < BicOf(*best)) best = &trial;
  }
  return best;
}

const Trial* ModelComparison::Find(const Structure& structure) const {
  const auto found = std::ranges::find_if(
      trials_, [&](const Trial& trial) { return trial.structure.Name() == structure.Name(); });
  return found == trials_.end() ? nullptr : &*found;
}

const Trial* ModelComparison::WithSlope(const Trial& trial) const {
  const auto* law = trial.structure.identifier.options.Find<LawOption>();
  if (!law || law->law->name != Coulomb::name) return nullptr;
  const Trial* sloped = Find(trial.structure.With(LawOption{}));
  return sloped && sloped->gives_friction ? sloped : nullptr;
}

bool ModelComparison::Pushes(const Fit& fit) const {
  const Eigen::VectorXd residual = fit.rows.residual();
  if (residual.size() == 0) return false;
  const double mean = residual.mean();
  const double square = residual.squaredNorm() / static_cast<double>(residual.size());
  return Bic(square - mean * mean, 1, rows_) < Bic(square, 0, rows_);
}

std::string ModelComparison::WhyDominated(const Trial& one, const Trial& other) const {
  if (other.Parameters() < one.Parameters() && BicOf(other) <= BicOf(one)) {
    return ExplainOutdone(other.structure.Name());
  }

  // to leave little counts only with few parameters for so many rows
  if (other.Parameters() < kFewParameters * rows_ &&
      kHopeless * other.MeanSquare() < one.MeanSquare()) {
    return ExplainHopeless(other.structure.Name());
  }
  return "";
}

}  // namespace warmjoint

#include "identification/identifiers/tournament.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "identification/fit_data.h"
#include "identification/forward/map_points.h"
#include "identification/holdout/blocked_hold_out.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/identifiers/left_over_place.h"
#include "identification/identifiers/structures.h"
#include "identification/linear/linear_laws.h"
#include "identification/physical_bounds.h"
#include "models/friction/coulomb.h"
#include "models/recording/course_of.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

constexpr Eigen::Index kRows = 3000;    // on which structures are compared
constexpr double kHopeless = 4;         // of the mean squared error of another
constexpr double kFewParameters = 0.1;  // of the rows

Trial Try(const Structure& structure, const IdentifierInput& input) {
  Trial trial{structure, AtBounds(structure.Quick().Fitted(input), input.measurements)};
  trial.gives_friction = GivesFriction(trial.fit);
  // the shape that was chosen for a map stays with the structure
  if (!trial.fit.friction.maps.empty()) {
    trial.structure = structure.WithShapeOf(trial.fit.friction.maps[0]);
  }
  if (trial.gives_friction) return trial;

  // beyond doubt or perhaps by chance
  trial.told = Infer(trial.fit);
  trial.dropped =
      trial.told.status == Status::ok ? "gives no friction" : StatusName(trial.told.status);
  return trial;
}

}  // namespace

Tournament::Tournament(const IdentifierInput& input, const Selection& selection)
    : log_(Condense({input.measurements, selection}, kRows)),
      quick_(input.On(log_.view)),
      rows_(static_cast<double>(quick_.selection.count())) {}

void Tournament::Add(const std::vector<Structure>& structures) {
  for (const Structure& structure : structures) {
    quick_.Tell("trying " + structure.Name());
    trials_.push_back(Try(structure, quick_));
  }
}

void Tournament::LeaveOut(const std::vector<Structure>& structures, const std::string& why) {
  for (const Structure& structure : structures) {
    trials_.push_back({.structure = structure, .dropped = why});
    trials_.back().told.status = Status::not_identifiable;
  }
}

const Structure* Tournament::Best() const {
  const Trial* best = BestTrial();
  return best ? &best->structure : nullptr;
}

std::optional<double> Tournament::LagOfBest(const IdentifierInput& all) const {
  const Trial* best = BestTrial();
  if (!best) return std::nullopt;
  all.Tell("looking for a lag of the torque");
  const Fit& fit = best->fit;

  // jumps of E stand at rows: back to the samples with which those begin
  CourseStart start = fit.Start();
  for (EnergyJump& jump : start.jumps) jump.sample = log_.first[static_cast<size_t>(jump.sample)];
  return LagOf(best->structure, {fit.friction, fit.gravity, fit.inertia}, start, all);
}

bool Tournament::MayHaveMap() const {
  const Trial* best = BestTrial();
  if (!best) return true;
  const Measurements& m = log_.view.measurements;
  if (m.position_integrated) return KnowsMotorAngle(m);
  const MapPoints points = Kept(PointsOf(m), best->fit.used);
  return LeavesOverPlace(best->fit.residual(), points);
}

ChosenKernels Tournament::KernelsBesideBest(FittedGravity gravity) const {
  quick_.Tell("choosing the kernels of maps");
  // E as the best structure so far has it
  const Trial* best = BestTrial();
  Eigen::VectorXd energy;
  if (best) {
    const Fit& fit = best->fit;
    energy = PredictFriction(fit.friction, log_.view.measurements, fit.Start()).energy;
  }

  // energy-ml has both maps, over position and over the motor's angle
  const auto chosen = [&](WarmMap position) {
    const Options options =
        EnergyMl().options.With(GravityOption{gravity}).With(WarmMapOptions{{}, position});
    return MapBesideEnergy(quick_.With(options), energy);
  };
  ChosenKernels kernels;
  const Measurements& m = log_.view.measurements;
  if (!m.position_integrated) kernels.position = chosen(WarmMap::map);
  if (KnowsMotorAngle(m)) kernels.motor = chosen(WarmMap::motor);
  return kernels;
}

bool Tournament::MayWarm() const {
  return std::ranges::any_of(trials_, [](const Trial& trial) {
    const Identifier& identifier = trial.structure.identifier;
    if (identifier.name != EnergyMl().name) return false;
    // one without slope, where the joint has one, need not settle for its warming
    const bool too_poor = identifier.options.Get<LawOption>().law->name == Coulomb::name;
    return too_poor ? trial.gives_friction : trial.told.status != Status::not_identifiable;
  });
}

bool Tournament::MayWarmBeside(FittedGravity gravity) const {
  const Structure* best = Best();
  return MayWarm() || !best || best->gravity() == gravity;
}

bool Tournament::MayBendAndWarm() const {
  return MayWarm() ||
         Find(StribeckStructure(FittedWarming::none))->told.status != Status::not_identifiable;
}

bool Tournament::MayHaveTwoLevels(FittedWarming warming) const {
  const Trial& one = *Find(StribeckStructure(warming));
  if (one.told.status == Status::ok) return Pushes(one.fit);

  // where the curve does not fit: by a linear law, or by two levels without warming
  if (warming == FittedWarming::none) return Pushes(First().fit);
  const Trial* cold = Find(TwoLevelStribeckStructure(FittedWarming::none));
  return cold && cold->told.status == Status::ok;
}

void Tournament::DropOutdone() {
  // the best by BIC first: whatever outdoes one stands before it
  std::vector<Trial*> order;
  for (Trial& trial : trials_) {
    if (trial.outdone) trial.dropped.clear();
    trial.outdone = false;
    if (trial.dropped.empty()) order.push_back(&trial);
  }
  std::ranges::stable_sort(order, {}, [&](const Trial* one) { return BicOf(*one); });

  // dropped only by those that stand themselves
  std::vector<const Trial*> standing;
  for (Trial* one : order) {
    for (const Trial* other : standing) {
      if (one->dropped.empty()) one->dropped = WhyOutdone(*one, *other);
    }
    one->outdone = !one->dropped.empty();
    if (!one->outdone) standing.push_back(one);
  }
}

const Structure* Tournament::OnlyOne() const {
  const auto stands = [](const Trial& trial) { return trial.dropped.empty(); };
  if (std::ranges::count_if(trials_, stands) != 1) return nullptr;
  return &std::ranges::find_if(trials_, stands)->structure;
}

bool Tournament::HoldOut(Trial& trial, const std::vector<Eigen::Index>& bounds) {
  if (trial.errors) return true;
  quick_.Tell(fmt::format("comparing on {} held-out blocks: {}", bounds.size() - 1,
                          trial.structure.Name()));
  trial.errors = trial.structure.ErrorsOn(quick_, bounds);
  if (trial.errors && trial.errors->allFinite()) return true;
  trial.dropped = "fails without one of the blocks";
  return false;
}

std::vector<Contender> Tournament::Compare(int blocks) {
  const std::vector<Eigen::Index> bounds = CutIntoBlocks(quick_.selection, blocks);
  // one that fails outdoes nobody: those that it dropped stand again
  const auto fails = [&](Trial& trial) { return trial.dropped.empty() && !HoldOut(trial, bounds); };
  while (std::ranges::any_of(trials_, fails)) DropOutdone();

  std::vector<Contender> contenders;
  standing_.clear();
  for (size_t i = 0; i < trials_.size(); ++i) {
    const Trial& trial = trials_[i];
    if (!trial.dropped.empty()) continue;
    standing_.push_back(i);
    contenders.push_back(
        {trial.structure.Name(), *trial.errors, trial.MeanSquare(), trial.Parameters()});
  }
  return contenders;
}

std::vector<StructureTrial> Tournament::Told() const {
  std::vector<StructureTrial> told;
  for (const Trial& trial : trials_) {
    StructureTrial& one = told.emplace_back();
    one.name = trial.structure.Name();
    one.parameters = trial.Parameters();
    one.dropped = trial.dropped;
    if (trial.errors) one.rmse = std::sqrt(trial.errors->mean());
  }
  return told;
}

const Trial* Tournament::BestTrial() const {
  const Trial* best = nullptr;
  for (const Trial& trial : trials_) {
    if (trial.gives_friction && (!best || BicOf(trial) < BicOf(*best))) best = &trial;
  }
  return best;
}

const Trial* Tournament::Find(const Structure& structure) const {
  const auto found = std::ranges::find_if(
      trials_, [&](const Trial& trial) { return trial.structure.Name() == structure.Name(); });
  return found == trials_.end() ? nullptr : &*found;
}

bool Tournament::Pushes(const Fit& fit) const {
  const Eigen::VectorXd residual = fit.residual();
  if (residual.size() == 0) return false;
  const double mean = residual.mean();
  const double square = residual.squaredNorm() / static_cast<double>(residual.size());
  return Bic(square - mean * mean, 1, rows_) < Bic(square, 0, rows_);
}

std::string Tournament::WhyOutdone(const Trial& one, const Trial& other) const {
  if (other.Parameters() < one.Parameters() && BicOf(other) <= BicOf(one)) {
    return fmt::format("outdone by {}, which is simpler", other.structure.Name());
  }

  // to leave little counts only with few parameters for so many rows
  if (other.Parameters() < kFewParameters * rows_ &&
      kHopeless * other.MeanSquare() < one.MeanSquare()) {
    return fmt::format("{} leaves less than half of its residual", other.structure.Name());
  }
  return "";
}

}  // namespace warmjoint

#include "identification/identifiers/tournament.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "identification/fit_data.h"
#include "identification/forward/map_points.h"
#include "identification/holdout/blocked_hold_out.h"
#include "identification/identifiers/energy_ml_with_maps.h"
#include "identification/identifiers/lag_of_log.h"
#include "identification/identifiers/left_over_place.h"
#include "identification/identifiers/stribeck.h"
#include "identification/linear/rigid_part.h"
#include "identification/physical_bounds.h"
#include "identification/read_options.h"
#include "models/friction/coulomb.h"
#include "models/recording/course_of.h"
#include "models/recording/motor_angle.h"

namespace warmjoint::inline identification {
namespace {

constexpr Eigen::Index kRows = 3000;    // on which structures are compared
constexpr double kHopeless = 4;         // of the mean squared error of another
constexpr double kFewParameters = 0.1;  // of the rows
constexpr double kBeyondDoubt =
    3.5;  // standard errors: by chance once in a thousand logs, of two values

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
  const MapPoints points = Kept(PointsOf(log_.view.measurements), best->fit.used);
  return LeavesOverPlace(best->fit.residual(), points);
}

ChosenKernels Tournament::KernelsBesideBest(const std::string& gravity) const {
  quick_.Tell("choosing the kernels of maps");
  // E as the best structure so far has it
  const Trial* best = BestTrial();
  Eigen::VectorXd energy;
  if (best) {
    const Fit& fit = best->fit;
    energy = PredictFriction(fit.friction, log_.view.measurements, fit.Start()).energy;
  }

  // energy-ml has both maps, over position and over the motor's angle
  const auto chosen = [&](const char* position) {
    const Options options = ReadOptions(EnergyMlWithMaps().options,
                                        {{kGravityOption, gravity}, {"position", position}}, {});
    return MapBesideEnergy(quick_.With(options), energy);
  };
  ChosenKernels kernels{chosen("map"), {}};
  if (KnowsMotorAngle(log_.view.measurements)) kernels.motor = chosen("motor");
  return kernels;
}

bool Tournament::MayWarm() const {
  return std::ranges::any_of(trials_, [](const Trial& trial) {
    if (trial.structure.identifier.name != EnergyMlWithMaps().name) return false;
    // one without slope, where the joint has one, need not settle for its warming
    const bool too_poor = trial.structure.Given("law", "") == Coulomb::name;
    return too_poor ? trial.gives_friction : trial.told.status != Status::not_identifiable;
  });
}

bool Tournament::MayWarmBeside(const std::string& gravity) const {
  const Structure* best = Best();
  return MayWarm() || !best || best->Given(kGravityOption, "none") == gravity;
}

bool Tournament::MayBendAndWarm() const {
  return MayWarm() || Find(StribeckStructure("none"))->told.status != Status::not_identifiable;
}

bool Tournament::MayHaveTwoLevels(const std::string& warming) const {
  const Trial& one = *Find(StribeckStructure(warming));
  if (one.told.status == Status::ok) return Pushes(one.fit);

  // where the curve does not fit: by a linear law, or by two levels without warming
  if (warming == "none") return Pushes(First().fit);
  const Trial* cold = Find(TwoLevelStribeckStructure("none"));
  return cold && cold->told.status == Status::ok;
}

void Tournament::DropHopeless() {
  // maps that hold gravity which another structure tells apart
  for (Trial& one : trials_) {
    for (const Trial& other : trials_) {
      if (!one.dropped.empty() || !other.dropped.empty() || !HidesGravity(one, other)) continue;
      one.dropped =
          fmt::format("takes gravity into its map, which {} tells apart", other.structure.Name());
    }
  }

  // then what is outdone by any that stood until here, dropped meanwhile or not
  std::vector<bool> standing;
  for (const Trial& trial : trials_) standing.push_back(trial.dropped.empty());
  for (size_t i = 0; i < trials_.size(); ++i) {
    for (size_t j = 0; j < trials_.size() && standing[i] && trials_[i].dropped.empty(); ++j) {
      if (j != i && standing[j]) trials_[i].dropped = WhyOutdone(trials_[i], trials_[j]);
    }
  }
}

const Structure* Tournament::OnlyOne() const {
  const auto stands = [](const Trial& trial) { return trial.dropped.empty(); };
  if (std::ranges::count_if(trials_, stands) != 1) return nullptr;
  return &std::ranges::find_if(trials_, stands)->structure;
}

std::vector<Contender> Tournament::Compare(int blocks) {
  const std::vector<Eigen::Index> bounds = CutIntoBlocks(quick_.selection, blocks);
  std::vector<Contender> contenders;
  standing_.clear();
  for (size_t i = 0; i < trials_.size(); ++i) {
    Trial& trial = trials_[i];
    if (!trial.dropped.empty()) continue;
    quick_.Tell(fmt::format("comparing on {} held-out blocks: {}", blocks, trial.structure.Name()));
    trial.errors = trial.structure.ErrorsOn(quick_, bounds);
    if (!trial.errors) trial.dropped = "fails without one of the blocks";
    if (!trial.errors || !trial.errors->allFinite()) continue;
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

bool Tournament::HidesGravity(const Trial& one, const Trial& other) const {
  // the same structure, one with a map and no gravity, the other with gravity
  const auto same = [&](const char* option) {
    return one.structure.Given(option, "") == other.structure.Given(option, "");
  };
  const bool alike = one.structure.identifier.name == other.structure.identifier.name &&
                     same("law") && same("position") && !one.fit.friction.maps.empty();
  if (!alike || one.fit.gravity || !other.fit.gravity) return false;

  // beyond the reach of its own interval
  const Inference told = Infer(other.fit);
  for (size_t i = 0; i < other.fit.parameters.size(); ++i) {
    const KnownParameter& known = told.parameters[i];
    const bool weight = other.fit.parameters[i].role == Role::gravity && known.std;
    if (weight && std::abs(known.value) > kBeyondDoubt * *known.std) return true;
  }
  return false;
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

}  // namespace warmjoint::inline identification

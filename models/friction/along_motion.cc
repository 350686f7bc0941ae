#include "models/friction/along_motion.h"

#include <cmath>

#include "models/friction/intervals.h"
#include "models/friction/laws.h"

namespace warmjoint {
namespace {

using Eigen::Index;

double At(const Eigen::VectorXd& column, Index i) { return column.size() > 0 ? column[i] : 0.0; }

/// What one sample gives.
struct Sample {
  double force = 0;
  double loss = 0;
  bool drives_joint = false;
};

/// A law that slides steadily wherever the joint moves.
template <typename L>
class LawAlong {
 public:
  LawAlong(const JointFriction& joint, const JointTrajectory& trajectory)
      : joint_(joint), trajectory_(trajectory) {}

  Sample operator()(Index i, const JointPlace& place) {
    const double v = trajectory_.velocity[i];
    if (v == 0) return {};
    const double force = ForceAt(v, i, place);
    return {force, LossAt(i, place, force), DrivesJoint(v, force)};
  }

  static constexpr bool kHasBristle = false;
  double bristle() const { return 0; }

 private:
  double ForceAt(double v, Index i, const JointPlace& place) const {
    return joint_.SlidingForceBy<L>(v, place) + Sign(v) * At(trajectory_.level, i);
  }

  /// Until the next sample, W. force: at the sample, N.m or N.
  double LossAt(Index i, const JointPlace& place, double force) const {
    if (trajectory_.mean_speed.size() == 0) return Loss(trajectory_.velocity[i], force);
    const double v = trajectory_.loss_velocity[i];
    return Loss(trajectory_.mean_speed[i],
                v == trajectory_.velocity[i] ? force : ForceAt(v, i, place));
  }

  const JointFriction& joint_;
  const JointTrajectory& trajectory_;
};

/// A law whose own bristle follows the motion.
template <LawWithBristle L>
class LawAlong<L> {
 public:
  LawAlong(const JointFriction& joint, const JointTrajectory& trajectory)
      : joint_(joint),
        trajectory_(trajectory),
        pieces_(trajectory.time, trajectory.velocity, trajectory.starts),
        state_(joint.values().data()) {}

  Sample operator()(Index i, const JointPlace& place) {
    const double v = trajectory_.velocity[i], extra = At(trajectory_.level, i);
    const int side = v < 0 ? -1 : 1;
    const double added = joint_.AddedLevel(side, std::abs(v), place) + extra;

    // a recording begins with the bristle bent by its first torque, where it is given, or sliding
    if (pieces_.Begins(i) && trajectory_.torque.size() > 0) {
      state_.BeginBent(v, added, trajectory_.torque[i]);
    } else if (pieces_.Begins(i)) {
      state_.BeginSliding(v, added);
    } else {
      Follow(i, place);
    }
    before_ = place;

    // the part of the slope that follows E is beside the law
    const double slope = joint_.SlopeChange(place.energy);
    const double steady = joint_.SlidingForce(v, place) + Sign(v) * extra;
    return {state_.Force(v, added) + slope * v,
            std::max(0.0, state_.Loss(v, added) + slope * v * v), DrivesJoint(v, steady)};
  }

  static constexpr bool kHasBristle = true;
  double bristle() const { return state_.load(); }

 private:
  /// The path to sample i, on which all that joins the level goes linearly in time.
  void Follow(Index i, const JointPlace& place) {
    for (const MotionPiece& piece : pieces_.Before(i)) {
      // what joins the level at either sample, and linearly in between
      const auto added = [&](Index k, const JointPlace& at) {
        return joint_.AddedLevel(piece.side, std::abs(trajectory_.velocity[k]), at) +
               At(trajectory_.level, k);
      };
      const double from = added(i - 1, before_), to = added(i, place);
      const auto between = [from, to](double share) { return from + (to - from) * share; };
      state_.Follow(piece, between(piece.begin), between(piece.end));
    }
  }

  const JointFriction& joint_;
  const JointTrajectory& trajectory_;
  MotionPieces pieces_;
  BristleState<L> state_;
  JointPlace before_;  // at the sample before
};

/// Heat over the interval that follows each sample.
class HeatAlong {
 public:
  HeatAlong(const Friction& friction, const JointTrajectory& trajectory) {
    const Index n = trajectory.velocity.size();
    if (!friction.thermal || n < 2) {
      intervals_ = EvenIntervals(n, 1);
      heats_.resize(1);
      return;
    }
    intervals_ =
        trajectory.step > 0 ? EvenIntervals(n, trajectory.step) : FindIntervals(trajectory.time);
    for (const double h : intervals_.length) heats_.push_back(DiscretiseHeat(friction, h));
  }

  const Heat& After(Index i) const {
    return heats_[static_cast<size_t>(intervals_.which[static_cast<size_t>(i)])];
  }

 private:
  Intervals intervals_;
  std::vector<Heat> heats_;
};

JointPlace PlaceAt(const JointTrajectory& trajectory, Index i, double energy) {
  JointPlace place{At(trajectory.position, i), energy, At(trajectory.load, i)};
  if (trajectory.motor_position.size() > 0) place.motor_position = trajectory.motor_position[i];
  return place;
}

template <typename L>
Prediction Run(const Friction& friction, const JointFriction& joint,
               const JointTrajectory& trajectory, const ThermalStart& start) {
  const Index n = trajectory.velocity.size();
  Prediction result{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n), {}, n, {}};
  LawAlong<L> law(joint, trajectory);
  if (law.kHasBristle) result.bristle.resize(n);
  const HeatAlong heat(friction, trajectory);

  FrictionState& state = result.end;
  state = {0, start.energy, start.second_energy};
  auto cold = trajectory.starts.begin();
  auto jump = start.jumps.begin();
  for (Index i = 0; i < n; ++i) {
    // the joint may be cold again, or its heat be changed by a jump
    if (cold != trajectory.starts.end() && *cold == i) {
      state.energy = state.second_energy = 0;
      ++cold;
    }
    for (; jump != start.jumps.end() && jump->sample == i; ++jump) state.energy += jump->change;

    // friction at this sample, with the heat that it begins with
    const double energy = state.energy + state.second_energy;
    const Sample sample = law(i, PlaceAt(trajectory, i, energy));
    result.force[i] = sample.force;
    result.loss[i] = sample.loss;
    result.energy[i] = energy;
    if (law.kHasBristle) result.bristle[i] = law.bristle();
    if (sample.drives_joint && result.first_driving == n) result.first_driving = i;

    // hold the loss until the next sample
    if (i + 1 == n) break;
    const Heat& hold = heat.After(i);
    const Heating by{sample.loss, At(trajectory.ambient_rise, i), trajectory.velocity[i]};
    state.energy = hold.First(state.energy, by);
    state.second_energy = hold.Second(state.second_energy, by);
  }

  // what the joint remembers at the end
  state.bristle = law.bristle();
  if (L::pre_sliding == PreSliding::breakaway && n > 0)
    state.slip = Sign(trajectory.velocity[n - 1]);
  return result;
}

}  // namespace

AlongMotion::AlongMotion(const Friction& friction) : friction_(friction), joint_(friction) {}

Prediction AlongMotion::Predict(const JointTrajectory& trajectory,
                                const ThermalStart& start) const {
  return ForLawNamed(AllLaws{}, friction_.law,
                     [&]<typename L>() { return Run<L>(friction_, joint_, trajectory, start); });
}

}  // namespace warmjoint

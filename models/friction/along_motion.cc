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
  bool feeds_itself = false;
};

/// A law that slides steadily wherever the joint moves.
template <typename L>
class LawAlong {
 public:
  LawAlong(const JointFriction& joint, const JointCourse& course)
      : joint_(joint), course_(course) {}

  Sample operator()(Index i, const JointPlace& place) {
    const double v = course_.velocity[i];
    if (v == 0) return {};
    const double force = ForceAt(v, i, place);
    return {force, LossAt(i, place, force), FeedsItself(v, force)};
  }

  static constexpr bool kHasBristle = false;
  double bristle() const { return 0; }

 private:
  double ForceAt(double v, Index i, const JointPlace& place) const {
    return joint_.SlidingForceBy<L>(v, place) + Sign(v) * At(course_.level, i);
  }

  /// Until the next sample, W. force: at the sample, N.m or N.
  double LossAt(Index i, const JointPlace& place, double force) const {
    if (course_.mean_speed.size() == 0) return Loss(course_.velocity[i], force);
    const double v = course_.loss_velocity[i];
    return Loss(course_.mean_speed[i], v == course_.velocity[i] ? force : ForceAt(v, i, place));
  }

  const JointFriction& joint_;
  const JointCourse& course_;
};

/// A law whose own bristle follows the motion.
template <LawWithBristle L>
class LawAlong<L> {
 public:
  LawAlong(const JointFriction& joint, const JointCourse& course)
      : joint_(joint),
        course_(course),
        pieces_(course.time, course.velocity, course.starts),
        state_(joint.values().data()) {}

  Sample operator()(Index i, const JointPlace& place) {
    const double v = course_.velocity[i], extra = At(course_.level, i);
    const int side = v < 0 ? -1 : 1;
    const double added = joint_.AddedLevel(side, std::abs(v), place) + extra;

    // a recording begins with the bristle bent by its first torque, where it is given, or sliding
    if (pieces_.Begins(i) && course_.torque.size() > 0) {
      state_.BeginBent(v, added, course_.torque[i]);
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
            std::max(0.0, state_.Loss(v, added) + slope * v * v), FeedsItself(v, steady)};
  }

  static constexpr bool kHasBristle = true;
  double bristle() const { return state_.load(); }

 private:
  /// The way to sample i, on which all that joins the level goes linearly in time.
  void Follow(Index i, const JointPlace& place) {
    for (const MotionPiece& piece : pieces_.Before(i)) {
      // what joins the level at either sample, and linearly in between
      const auto added = [&](Index k, const JointPlace& at) {
        return joint_.AddedLevel(piece.side, std::abs(course_.velocity[k]), at) +
               At(course_.level, k);
      };
      const double from = added(i - 1, before_), to = added(i, place);
      const auto between = [from, to](double share) { return from + (to - from) * share; };
      state_.Follow(piece, between(piece.begin), between(piece.end));
    }
  }

  const JointFriction& joint_;
  const JointCourse& course_;
  MotionPieces pieces_;
  BristleCourse<L> state_;
  JointPlace before_;  // at the sample before
};

/// Heat over the interval that follows each sample.
class HeatAlong {
 public:
  HeatAlong(const Friction& friction, const JointCourse& course) {
    const Index n = course.velocity.size();
    if (!friction.thermal || n < 2) {
      intervals_ = {{1}, std::vector<int>(static_cast<size_t>(n), 0), 1};
      heats_.resize(1);
      return;
    }
    intervals_ = course.step > 0 ? EvenIntervals(n, course.step) : FindIntervals(course.time);
    for (const double h : intervals_.length) heats_.push_back(DiscretiseHeat(friction, h));
  }

  const Heat& After(Index i) const {
    return heats_[static_cast<size_t>(intervals_.which[static_cast<size_t>(i)])];
  }

 private:
  Intervals intervals_;
  std::vector<Heat> heats_;
};

JointPlace PlaceAt(const JointCourse& course, Index i, double energy) {
  JointPlace place{At(course.position, i), energy, At(course.load, i)};
  if (course.motor_position.size() > 0) place.motor_position = course.motor_position[i];
  return place;
}

template <typename L>
Prediction Run(const Friction& friction, const JointFriction& joint, const JointCourse& course,
               const CourseStart& start) {
  const Index n = course.velocity.size();
  Prediction result{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n), {}, n, {}};
  LawAlong<L> law(joint, course);
  if (law.kHasBristle) result.bristle.resize(n);
  const HeatAlong heat(friction, course);

  FrictionState& state = result.end;
  state = {0, start.energy, start.second_energy};
  auto cold = course.starts.begin();
  auto jump = start.jumps.begin();
  for (Index i = 0; i < n; ++i) {
    // the joint may be cold again, or its heat be changed by a jump
    if (cold != course.starts.end() && *cold == i) {
      state.energy = state.second_energy = 0;
      ++cold;
    }
    for (; jump != start.jumps.end() && jump->sample == i; ++jump) state.energy += jump->change;

    // friction at this sample, with the heat that it begins with
    const double energy = state.energy + state.second_energy;
    const Sample sample = law(i, PlaceAt(course, i, energy));
    result.force[i] = sample.force;
    result.loss[i] = sample.loss;
    result.energy[i] = energy;
    if (law.kHasBristle) result.bristle[i] = law.bristle();
    if (sample.feeds_itself && result.feeds_itself == n) result.feeds_itself = i;

    // hold the loss until the next sample
    if (i + 1 == n) break;
    const Heat& hold = heat.After(i);
    const Heating by{sample.loss, At(course.ambient_rise, i), course.velocity[i]};
    state.energy = hold.First(state.energy, by);
    state.second_energy = hold.Second(state.second_energy, by);
  }

  // what the joint remembers at the end
  state.bristle = law.bristle();
  if (L::pre_sliding == PreSliding::breakaway && n > 0) state.slip = Sign(course.velocity[n - 1]);
  return result;
}

}  // namespace

AlongMotion::AlongMotion(const Friction& friction) : friction_(friction), joint_(friction) {}

Prediction AlongMotion::Predict(const JointCourse& course, const CourseStart& start) const {
  return ForLawNamed(AllLaws{}, friction_.law,
                     [&]<typename L>() { return Run<L>(friction_, joint_, course, start); });
}

}  // namespace warmjoint

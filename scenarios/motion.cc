#include "scenarios/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "models/foundation/bad_input.h"

namespace warmjoint {
namespace {

/// Signed velocities, one a segment, without end.
class VelocitySequence {
 public:
  VelocitySequence(const Motion& motion, bool travels, RandomStream& random)
      : motion_(motion), travels_(travels), random_(random) {}

  double Next() {
    const size_t segment = segment_++;
    const double turn = segment % 2 == 0 ? 1.0 : -1.0;
    switch (motion_.order) {
      case SegmentOrder::alternating:
        return turn * (motion_.speeds.draws ? Draw() : Alternating(segment));
      case SegmentOrder::in_order:
        return turn * InOrder(segment);
      case SegmentOrder::shuffled:
        return travels_ ? turn * std::abs(Shuffled()) : Shuffled();
    }
    return 0;
  }

 private:
  double Draw() { return std::abs(motion_.speeds.draws->Draw(random_)); }

  double Alternating(size_t segment) const {
    // an even list is shifted after each round, so that each speed gets both signs
    const size_t n = motion_.speeds.list.size();
    const size_t shift = n % 2 == 0 ? segment / n : 0;
    return motion_.speeds.list[(segment + shift) % n];
  }

  double InOrder(size_t segment) {
    if (!motion_.speeds.draws) return motion_.speeds.list[segment / 2 % motion_.speeds.list.size()];
    // one draw for the way there and back
    if (segment % 2 == 0) pair_speed_ = Draw();
    return pair_speed_;
  }

  double Shuffled() {
    if (motion_.speeds.draws) {
      const double speed = Draw();
      return random_.Below(2) == 0 ? speed : -speed;
    }
    // a round is used up before the next is drawn
    if (round_.empty()) FillRound();
    const double velocity = round_.back();
    round_.pop_back();
    return velocity;
  }

  /// All speeds in both signs, in an order by chance (Fisher-Yates).
  void FillRound() {
    for (double speed : motion_.speeds.list) round_.insert(round_.end(), {speed, -speed});
    for (size_t i = round_.size() - 1; i > 0; --i)
      std::swap(round_[i], round_[random_.Below(i + 1)]);
  }

  const Motion& motion_;
  bool travels_;
  RandomStream& random_;
  size_t segment_ = 0;
  double pair_speed_ = 0;
  std::vector<double> round_;  // what is left of a shuffled round
};

/// Refuses plans of more segments than anyone holds speeds for, before they take the memory.
void CheckSegments(std::size_t segments, double duration) {
  constexpr std::size_t most = 1'000'000;
  if (segments <= most) return;
  Refuse({},
         "motion makes more than {} segments in {} s; lengthen its hold, travel, rests or phases",
         most, duration);
}

/// Collects segments, cut by the rests and by the end.
class PlanBuilder {
 public:
  PlanBuilder(const std::optional<Rests>& rests, double duration)
      : rests_(rests),
        duration_(duration),
        until_rest_(rests ? rests->run : std::numeric_limits<double>::infinity()) {}

  bool full() const { return time_ >= duration_; }

  void Add(double duration, double velocity) {
    while (duration > 0 && !full()) {
      // up to the next rest, which does not shorten the motion
      const double moving = std::min(duration, until_rest_);
      Append(moving, velocity);
      duration -= moving;
      until_rest_ -= moving;
      if (until_rest_ > 0) continue;
      Append(rests_->rest, 0);
      until_rest_ = rests_->run;
    }
  }

  std::vector<MotionSegment> Take() { return std::move(plan_); }

 private:
  void Append(double duration, double velocity) {
    const double left = duration_ - time_;
    if (left <= 0) return;
    plan_.push_back({std::min(duration, left), velocity});
    CheckSegments(plan_.size(), duration_);
    // the plan ends exactly at its duration
    time_ = duration < left ? time_ + duration : duration_;
  }

  const std::optional<Rests>& rests_;
  double duration_;
  double until_rest_;  // s of motion
  double time_ = 0;    // s
  std::vector<MotionSegment> plan_;
};

std::vector<MotionSegment> PlanPhases(const std::vector<MotionPhase>& phases, double duration,
                                      RandomStream& random) {
  std::vector<MotionSegment> plan;
  double left = duration;
  // phase after phase, again from the first; the last is cut
  for (size_t i = 0; left > 0; i = (i + 1) % phases.size()) {
    const double lasts = std::min(phases[i].duration, left);
    if (phases[i].motion) {
      const auto part = PlanMotion(*phases[i].motion, lasts, {}, random);
      plan.insert(plan.end(), part.begin(), part.end());
    } else {
      plan.push_back({lasts, 0});
    }
    left -= lasts;
    CheckSegments(plan.size(), duration);
  }
  return plan;
}

}  // namespace

std::optional<std::pair<double, double>> TravelLimits(const Motion& motion,
                                                      std::pair<double, double> joint_limits) {
  return motion.travel.joint_limits ? joint_limits : motion.travel.limits;
}

double StartPosition(const Motion& motion, std::pair<double, double> joint_limits) {
  if (motion.moves) return 0.5 * (motion.moves->between.first + motion.moves->between.second);
  const auto limits = TravelLimits(motion, joint_limits);
  return limits ? limits->first : motion.start;
}

bool Motion::CornersAscend() const {
  const auto not_after = [](const VelocityCorner& a, const VelocityCorner& b) {
    return b.time <= a.time;
  };
  return std::ranges::adjacent_find(corners, not_after) == corners.end();
}

void ReadValue(const Node& node, Speeds* value, const FieldInfo&) {
  // drawn anew for each segment, or a list
  if (IsDistribution(node)) {
    ReadValue(node, &value->draws.emplace(), {.bounds = {.at_least = 0}});
    return;
  }
  for (const Node& speed : node.List(
           "a list of speeds, for example [0.1, 1], or a distribution as {uniform: [0.1, 1]}")) {
    value->list.push_back(speed.Number({.above = 0}));
  }
}

Tree WriteValue(const Speeds& value) {
  if (value.draws) return WriteValue(*value.draws);
  return value.list.empty() ? Tree() : Tree(value.list);
}

void ReadValue(const Node& node, Travel* value, const FieldInfo&) {
  value->joint_limits = node.IsScalar() && node.Text() == "joint_limits";
  if (!value->joint_limits) value->limits = node.Interval();
}

Tree WriteValue(const Travel& value) {
  if (value.joint_limits) return "joint_limits";
  return value.limits ? Tree{value.limits->first, value.limits->second} : Tree();
}

void ReadValue(const Node& node, VelocityCorner* value, const FieldInfo&) {
  const std::vector<Node> pair = node.List("[time, velocity]");
  if (pair.size() != 2) node.RefuseValue("[time, velocity]");
  *value = {pair[0].Number({.at_least = 0}), pair[1].Number()};
}

Tree WriteValue(const VelocityCorner& value) { return {value.time, value.velocity}; }

std::vector<MotionSegment> PlanMotion(const Motion& motion, double duration,
                                      std::pair<double, double> joint_limits,
                                      RandomStream& random) {
  if (!motion.phases.empty()) return PlanPhases(motion.phases, duration, random);

  // each segment lasts for the hold, or from one limit to the other
  const auto limits = TravelLimits(motion, joint_limits);
  VelocitySequence velocities(motion, limits.has_value(), random);
  PlanBuilder plan(motion.rests, duration);
  while (!plan.full()) {
    const double velocity = velocities.Next();
    plan.Add(limits ? (limits->second - limits->first) / std::abs(velocity) : motion.hold,
             velocity);
  }
  return plan.Take();
}

}  // namespace warmjoint

// Motions of several joints of a robot at once.
#include <fmt/format.h>
#include <warmjoint/design.h>

#include <algorithm>
#include <cmath>

#include "models/foundation/bad_input.h"
#include "models/robots/robot_folder.h"
#include "tools/design/motion/design_joint.h"
#include "tools/design/motion/robot_room.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kStep =
    0.01;  // s, between looks; why: what moves at 1 m/s comes 5 mm nearer before and after

/// The limits of a joint: those that are given, and those of the robot's file.
MotionLimits LimitsOf(const MotionLimits& given, const RoomJoint& joint) {
  MotionLimits limits = given;
  if (joint.position) {
    auto [lower, upper] = *joint.position;
    if (given.position) {
      lower = std::max(lower, (*given.position)[0]);
      upper = std::min(upper, (*given.position)[1]);
    }
    if (!(lower < upper)) {
      Refuse({"--limits"}, "position {:g} to {:g} has nothing of joint '{}', {:g} to {:g}",
             (*given.position)[0], (*given.position)[1], joint.name, (*joint.position)[0],
             (*joint.position)[1]);
    }
    limits.position = {lower, upper};
  }
  if (joint.torque) limits.torque = std::min(given.torque.value_or(kInfinity), *joint.torque);
  auto& [slowest, fastest] = limits.velocity;
  if (joint.velocity) fastest = std::min(fastest, *joint.velocity);
  // speeds at which a stroke through half of the room is held as long as its ramps last
  if (limits.position) {
    const double room = (*limits.position)[1] - (*limits.position)[0];
    fastest = std::min(fastest, 0.999 * std::sqrt(room / 6 * limits.acceleration));
  }
  // as far below the fastest as was asked
  slowest = std::min(slowest, fastest * given.velocity[0] / given.velocity[1]);
  return limits;
}

/// Of all joints, lower and upper; what turns freely, once round. [n x 2]
Eigen::MatrixX2d RoomOf(const std::vector<MotionLimits>& limits) {
  Eigen::MatrixX2d room(std::ssize(limits), 2);
  for (Index j = 0; j < room.rows(); ++j) {
    const auto [lower, upper] =
        limits[static_cast<size_t>(j)].position.value_or(std::array{-M_PI, M_PI});
    room.row(j) << lower, upper;
  }
  return room;
}

/// Each joint by itself, a seed further each, so that equal joints do not move alike; as slow to speed up as its torque asks.
std::vector<ExpectedJoint> ExpectAll(RobotRoom& room, const RobotDesignSettings& settings,
                                     const std::optional<PreparedLog>& after,
                                     std::vector<std::string>& notices) {
  std::vector<MotionLimits> limits;
  for (const RoomJoint& joint : room.joints()) {
    limits.push_back(LimitsOf(settings.each.limits, joint));
  }
  std::vector<ExpectedJoint> expected;
  for (size_t j = 0; j < limits.size(); ++j) {
    const RoomJoint& joint = room.joints()[j];
    DesignSettings one = settings.each;
    one.limits = limits[j];
    one.joint = joint.kind;
    one.seed += j;
    const auto prior = settings.priors.find(joint.name);
    if (prior != settings.priors.end()) one.prior = prior->second;
    expected.push_back(Expect(one, after));
    const double level = expected.back().Level(expected.back().settings.limits.velocity[1]);
    const double most = room.Acceleration(j, RoomOf(limits), level);
    if (most >= one.limits.acceleration) continue;
    if (!(most > 0)) {
      Refuse({"--joint"},
             "'{}' has an effort of {:g} {}, of which gravity and a friction of {:.3g} leave "
             "nothing; lower --limits velocity, or say by --prior what friction is expected",
             joint.name, *joint.torque, kTorqueUnit.For(joint.kind), level);
    }
    MotionLimits slower = settings.each.limits;
    slower.acceleration = most;
    one.limits = LimitsOf(slower, joint);
    expected.back() = Expect(one, after);
    notices.push_back(fmt::format(
        "{} speeds up by {:.3g} {}/s^2 at most, as its effort of {:g} {} allows", joint.name, most,
        kPositionUnit.For(joint.kind), *joint.torque, kTorqueUnit.For(joint.kind)));
  }
  return expected;
}

/// How a joint gives way in a block: as planned, in the other direction, with ever shorter strokes, at last by a rest.
struct WayOut {
  double hold = 0;
  bool turned = false;
  bool rests = false;
};

std::vector<WayOut> WaysOut(const MotionPath& path, const SpeedBlock& block, double hold) {
  std::vector<WayOut> ways;
  if (block.speed != 0) {
    for (double one = hold; one >= path.Shortest(block.speed); one /= 2) {
      ways.push_back({one, false});
      ways.push_back({one, true});
    }
  }
  ways.push_back({hold, false, true});
  return ways;
}

/// Lays out the blocks of all joints side by side.
class RobotPaths {
 public:
  RobotPaths(RobotRoom& room, const std::vector<ExpectedJoint>& expected)
      : room_(room), expected_(expected) {
    std::vector<MotionLimits> limits;
    for (const ExpectedJoint& one : expected) limits.push_back(one.settings.limits);
    start_ = room.Begin(RoomOf(limits));
    for (size_t j = 0; j < limits.size(); ++j) {
      paths_.emplace_back(limits[j], start_[static_cast<Index>(j)]);
    }
    kept_from_.resize(limits.size());
  }

  /// Of each joint its block of the same time.
  void Add(const std::vector<SpeedBlock>& blocks) {
    std::vector<std::vector<WayOut>> ways;
    for (size_t j = 0; j < blocks.size(); ++j) {
      ways.push_back(WaysOut(paths_[j], blocks[j], expected_[j].settings.hold));
    }
    std::vector<size_t> chosen(blocks.size(), 0);
    std::string last;
    while (true) {
      std::vector<MotionPath> longer = paths_;
      for (size_t j = 0; j < blocks.size(); ++j) {
        const WayOut& way = ways[j][chosen[j]];
        if (way.turned) longer[j].Turn();
        longer[j].Add({blocks[j].duration, way.rests ? 0 : blocks[j].speed}, way.hold);
      }
      const auto breach = FirstBreach(longer);
      if (!breach) {
        paths_ = std::move(longer);
        for (size_t j = 0; j < chosen.size(); ++j) {
          exchanged_ += chosen[j] > 0;
          if (blocks[j].speed != 0 && ways[j][chosen[j]].rests) kept_from_[j].push_back(last);
        }
        return;
      }
      // who can end it, and has given way least
      std::optional<size_t> next;
      for (const size_t j : breach->joints) {
        if (chosen[j] + 1 < ways[j].size() && (!next || chosen[j] < chosen[*next])) next = j;
      }
      // at rest they are where the last block left them, which was looked at
      if (!next) Refuse({"--joint"}, "{}, also at rest", breach->words);
      last = breach->words;
      ++chosen[*next];
    }
  }

  const std::vector<MotionPath>& paths() const { return paths_; }
  const VectorXd& start() const { return start_; }
  /// Of blocks, each joint's by itself.
  int exchanged() const { return exchanged_; }
  /// Of each joint, by what each of its blocks became a rest.
  const std::vector<std::vector<std::string>>& kept_from() const { return kept_from_; }

  /// Where all joints are after so many seconds.
  RobotMoment At(const std::vector<MotionPath>& paths, double time) const {
    const auto n = std::ssize(paths);
    RobotMoment moment{VectorXd(n), VectorXd(n), VectorXd(n), VectorXd(n)};
    for (Index j = 0; j < n; ++j) {
      const auto& knots = paths[static_cast<size_t>(j)].knots();
      const auto found = std::ranges::upper_bound(knots, time, {}, &MotionKnot::time);
      const auto to = std::clamp(found, knots.begin() + 1, knots.end() - 1);
      const MotionKnot &from = *(to - 1), now = Between(from, *to, time);
      moment.position[j] = now.position;
      moment.velocity[j] = now.velocity;
      const double lasts = to->time - from.time;
      moment.acceleration[j] = lasts > 0 ? (to->velocity - from.velocity) / lasts : 0;
      moment.friction[j] =
          now.velocity == 0
              ? 0
              : std::copysign(expected_[static_cast<size_t>(j)].Level(std::abs(now.velocity)),
                              now.velocity);
    }
    return moment;
  }

 private:
  /// Of the part that goes beyond the paths so far.
  std::optional<Breach> FirstBreach(const std::vector<MotionPath>& longer) {
    const double begin = paths_.front().knots().back().time;
    const double end = longer.front().knots().back().time;
    // even times, and both sides of each corner
    std::vector<double> times;
    for (double time = begin; time < end; time += kStep) times.push_back(time);
    for (const MotionPath& path : longer) {
      for (const MotionKnot& knot : path.knots() | std::views::reverse) {
        if (knot.time < begin) break;
        times.insert(times.end(),
                     {std::max(knot.time - 1e-6, begin), std::min(knot.time + 1e-6, end)});
      }
    }
    std::ranges::sort(times);
    for (const double time : times) {
      if (auto breach = room_.Look(At(longer, time), kStep)) return breach;
    }
    return std::nullopt;
  }

  RobotRoom& room_;
  const std::vector<ExpectedJoint>& expected_;
  VectorXd start_;
  std::vector<MotionPath> paths_;
  int exchanged_ = 0;
  std::vector<std::vector<std::string>> kept_from_;
};

/// What of a joint's torque shows that another one moves, in the places where blocks begin.
std::vector<DesignCoupling> CouplingOf(RobotRoom& room, const RobotPaths& paths,
                                       const std::vector<ExpectedJoint>& expected,
                                       const std::vector<double>& times) {
  const auto n = std::ssize(expected);
  VectorXd accelerations(n);
  for (Index j = 0; j < n; ++j) {
    accelerations[j] = expected[static_cast<size_t>(j)].settings.limits.acceleration;
  }
  Eigen::MatrixXd most = Eigen::MatrixXd::Zero(n, n);
  for (const double time : times) {
    const VectorXd place = paths.At(paths.paths(), time).position;
    most = most.cwiseMax(room.Coupling(place, paths.start(), accelerations));
  }
  std::vector<DesignCoupling> coupling;
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      if (most(i, j) <= *expected[static_cast<size_t>(i)].settings.noise) continue;
      coupling.push_back({room.joints()[static_cast<size_t>(i)].name,
                          room.joints()[static_cast<size_t>(j)].name, most(i, j)});
    }
  }
  return coupling;
}

/// Says what was exchanged. count: of blocks of each joint. Throws BadInput where a joint may not move at all.
void NoteExchanges(const RobotPaths& paths, const std::vector<RoomJoint>& joints, size_t count,
                   std::vector<std::string>& notices) {
  if (paths.exchanged() > 0) {
    notices.push_back(fmt::format(
        "{} of {} blocks were exchanged for others, in which links stay apart and torques within "
        "their limits",
        paths.exchanged(), joints.size() * count));
  }
  for (size_t j = 0; j < joints.size(); ++j) {
    const std::vector<std::string>& from = paths.kept_from()[j];
    if (from.empty()) continue;
    const std::vector<MotionKnot>& knots = paths.paths()[j].knots();
    if (std::ranges::all_of(knots, [](const MotionKnot& one) { return one.velocity == 0; })) {
      Refuse({"--joint"},
             "'{}' may not move from where the motion begins: {}; give another place by --at, a "
             "lower acceleration or velocity by --limits, or lower --clearance",
             joints[j].name, from.front());
    }
    notices.push_back(fmt::format("{} rests in {} of {} blocks for that, as where {}",
                                  joints[j].name, from.size(), count, from.front()));
  }
}

}  // namespace

RobotDesign DesignRobotMotion(const RobotDesignSettings& settings,
                              const std::optional<PreparedLog>& after, const WatchDesign& watch) {
  RobotRoom room(FindRobot(settings.robot, "design"), settings.joints, settings.at,
                 settings.clearance);
  const std::vector<RoomJoint>& joints = room.joints();
  if (after && joints.size() != 1) {
    Refuse({"--after"}, "is for one joint, and {} are to move", joints.size());
  }
  for (const auto& [name, file] : settings.priors) {
    if (std::ranges::find(joints, name, &RoomJoint::name) != joints.end()) continue;
    Refuse({"--prior"}, "is for '{}', which is none of the joints that move", name);
  }

  RobotDesign design;
  const std::vector<ExpectedJoint> expected = ExpectAll(room, settings, after, design.notices);
  std::vector<std::vector<SpeedBlock>> blocks;
  for (size_t j = 0; j < joints.size(); ++j) {
    blocks.push_back(BestBlocks(expected[j], [&](const std::string& words) {
      if (watch) watch(fmt::format("{}: {}", joints[j].name, words));
    }));
  }

  // side by side
  RobotPaths paths(room, expected);
  std::vector<double> times;
  for (size_t block = 0; block < blocks.front().size(); ++block) {
    if (watch)
      watch(fmt::format(
          "{:.0f} % of the motion looked at",
          100.0 * static_cast<double>(block) / static_cast<double>(blocks.front().size())));
    times.push_back(paths.paths().front().knots().back().time);
    std::vector<SpeedBlock> of_joints;
    for (const auto& one : blocks) of_joints.push_back(one[block]);
    paths.Add(of_joints);
  }

  NoteExchanges(paths, joints, blocks.front().size(), design.notices);

  // what it tells
  for (size_t j = 0; j < joints.size(); ++j) {
    const auto told = [&](const std::string& words) {
      if (watch) watch(fmt::format("{}: {}", joints[j].name, words));
    };
    design.joints.push_back(
        {Foretold(expected[j], paths.paths()[j].knots(), told), joints[j].name});
  }
  // what was found of the model meanwhile comes first
  design.notices.insert(design.notices.begin(), room.notices().begin(), room.notices().end());
  design.coupling = CouplingOf(room, paths, expected, times);
  return design;
}

}  // namespace warmjoint

// Bristles that the inertia matrix couples, against all ways to hold and slide, and their energy.
#include "sim/plugin/coupled_bristles.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "models/foundation/random_stream.h"
#include "sim/plugin/stability.h"
#include "tests/sim/plugin/friction_models.h"

namespace warmjoint {
namespace {

using namespace test;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStep = 0.002;  // s

/// A tree of four hinges, two of them on the same link.
constexpr char kTree[] = R"(
<mujoco>
  <worldbody>
    <body>
      <joint name="j0" axis="0 0 1"/><geom type="capsule" fromto="0 0 0 .3 0 0" size=".04" mass="2"/>
      <body pos=".3 0 0">
        <joint name="j1" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 .2 0 0" size=".03" mass="1"/>
        <body pos=".2 0 0">
          <joint name="j2" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 .2 0 .1" size=".02" mass=".4"/>
        </body>
        <body pos=".1 0 0">
          <joint name="j3" axis="1 0 0"/><geom type="capsule" fromto="0 0 0 0 .2 .1" size=".02" mass=".3"/>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>)";
constexpr int kJoints = 4;

/// A chain of so many hinges without branches.
std::string ChainXml(int joints) {
  std::string bodies, ends;
  const char* axes[] = {"0 0 1", "0 1 0", "1 0 0"};
  for (int i = 0; i < joints; ++i) {
    bodies += fmt::format(
        R"(<body pos=".2 0 0"><joint axis="{}"/><geom type="capsule" fromto="0 0 0 .2 0 .05" size=".03"/>)",
        axes[i % 3]);
    ends += "</body>";
  }
  return "<mujoco><worldbody>" + bodies + ends + "</worldbody></mujoco>";
}

MatrixXd InertiaOf(const mjModel* m, const mjData* d) {
  MatrixXd inertia(m->nv, m->nv);
  std::vector<double> unit(m->nv), column(m->nv);
  for (int i = 0; i < m->nv; ++i) {
    std::fill(unit.begin(), unit.end(), 0.0);
    unit[i] = 1;
    mj_mulM(m, d, column.data(), unit.data());
    for (int k = 0; k < m->nv; ++k) inertia(k, i) = column[k];
  }
  return inertia;
}

/// The projection by trying all sets of what is at a bound. level: {L-, L+} of each joint.
VectorXd Project(const MatrixXd& inertia, const VectorXd& aim,
                 const std::vector<std::array<double, 2>>& level) {
  const auto n = static_cast<int>(aim.size());
  for (int code = 0; code < std::pow(3, n); ++code) {
    std::vector<int> slides, side(n);
    for (int i = 0, left = code; i < n; ++i, left /= 3) {
      side[i] = left % 3 - 1;
      if (side[i] != 0) slides.push_back(i);
    }
    VectorXd slip = VectorXd::Zero(n), bound = VectorXd::Zero(n);
    for (const int i : slides) bound[i] = side[i] * level[i][side[i] > 0];
    if (!slides.empty()) {
      const VectorXd left = (aim - bound)(slides);
      const MatrixXd block = inertia(slides, slides);
      const VectorXd solved = block.ldlt().solve(left);
      slip(slides) = solved;
    }
    const VectorXd force = aim - inertia * slip;
    bool right = true;
    for (int i = 0; i < n; ++i) {
      right = right && (side[i] != 0 ? side[i] * slip[i] >= 0
                                     : force[i] <= level[i][1] && -force[i] <= level[i][0]);
    }
    if (right) return force;
  }
  ADD_FAILURE() << "no set is right";
  return aim;
}

/// {L-, L+} of each joint.
class Levels : public LevelSource {
 public:
  explicit Levels(std::vector<std::array<double, 2>> levels) : levels_(std::move(levels)) {}
  double LevelAt(size_t row, int side) const override { return levels_[row][side > 0]; }

 private:
  std::vector<std::array<double, 2>> levels_;
};

class CoupledBristlesOfATree : public testing::Test {
 protected:
  CoupledBristlesOfATree() : m(MustCompile(kTree)), d(mj_makeData(m.get())) {
    for (int i = 0; i < kJoints; ++i) joints.push_back({i, 0.1 + 0.05 * i});
  }

  /// Makes bristles of the joints; every other one asks for its levels.
  void MakeBristles(bool asks) {
    for (CoupledJoint& joint : joints) joint.asks_level = (joint.dof % 2 == 0) == asks;
    bristles = CoupledBristles(m.get(), joints);
    const auto none = [](int) { return 0.0; };
    bristles.SetTimestep(kStep, 1, none, none);
    numbers.assign(NumbersOf(bristles.size()), 0);
    for (const CoupledJoint& joint : joints) {
      RowOf(joint.dof)[kInertia] = joint.inertia;
      RowOf(joint.dof)[kPerInertia] = 1 / joint.inertia;
    }
  }

  Row RowOf(int dof) { return {numbers.data() + PlaceOf(bristles.RowOf(dof))}; }

  /// One step from these loads at the data's speeds.
  std::vector<BristleStep> Step(const std::vector<double>& loads,
                                const std::vector<std::array<double, 2>>& levels) {
    for (const CoupledJoint& joint : joints) {
      const Row row = RowOf(joint.dof);
      row[kSpeed] = d->qvel[joint.dof];
      row[kLoad] = loads[joint.dof];
      // of those that ask a guess, which may be wrong
      const auto [lower, upper] = levels[joint.dof];
      row[kUpper] = std::max(0.0, joint.asks_level ? 0.3 * upper : upper);
      row[kLower] = std::max(0.0, joint.asks_level ? 2 * lower : lower);
    }
    bristles.Step(d.get(), Levels(levels), {numbers.data()});
    std::vector<BristleStep> steps(kJoints);
    for (const CoupledJoint& joint : joints) {
      const Row row = RowOf(joint.dof);
      steps[joint.dof] = {row[kFriction], row[kLoad], row[kSliding] != 0};
    }
    return steps;
  }

  void Pose(RandomStream& random) {
    for (int i = 0; i < kJoints; ++i) d->qpos[i] = random.Uniform(-3, 3);
    mj_forward(m.get(), d.get());
    inertia = InertiaOf(m.get(), d.get());
  }

  /// The energy that the bristles hold, J.
  double Energy(const std::vector<double>& loads) const {
    VectorXd stretch(kJoints);
    for (int i = 0; i < kJoints; ++i) {
      stretch[i] = loads[i] * kStep * kStep / (kLoneBristles.stiffness * joints[i].inertia);
    }
    return kLoneBristles.stiffness / (2 * kStep * kStep) * stretch.dot(inertia * stretch);
  }

  Model m;
  Data d;
  MatrixXd inertia;
  std::vector<CoupledJoint> joints;
  CoupledBristles bristles;
  RowNumbers numbers;
};

TEST_F(CoupledBristlesOfATree, ProjectExactlyHoweverManySlide) {
  RandomStream random({3, 0}, Stream::test);
  std::array<int, kJoints + 1> slid{};
  for (int run = 0; run < 3000; ++run) {
    Pose(random);
    MakeBristles(run % 2 == 0);
    std::vector<std::array<double, 2>> level(kJoints);
    std::vector<double> loads(kJoints);
    VectorXd v(kJoints), stretch(kJoints);
    const double speed = std::pow(10, random.Uniform(-4, 1.5));
    for (int i = 0; i < kJoints; ++i) {
      level[i] = {random.Uniform(0, 3), random.Uniform(0, 3)};
      loads[i] = random.Uniform(-2, 2);
      v[i] = d->qvel[i] = speed * random.Normal();
      stretch[i] = loads[i] * kStep * kStep / (kLoneBristles.stiffness * joints[i].inertia);
    }
    const std::vector<BristleStep> steps = Step(loads, level);

    // twice, and the stretch that the first leaves
    const VectorXd trial = stretch + kStep * v;
    const VectorXd spring = kLoneBristles.stiffness / (kStep * kStep) * (inertia * trial);
    const VectorXd elastic = Project(inertia, spring, level);
    const VectorXd damping = kLoneBristles.damping / kStep * (inertia * v);
    const VectorXd force = Project(inertia, elastic + damping, level);
    const VectorXd next = kStep * kStep / kLoneBristles.stiffness * inertia.ldlt().solve(elastic);
    // rounding of what is projected
    const double rounding = 1e-12 * (spring.norm() + damping.norm() + 1);
    int sliding = 0;
    for (int i = 0; i < kJoints; ++i) {
      ASSERT_NEAR(steps[i].force, force[i], rounding) << "run " << run;
      ASSERT_NEAR(steps[i].load,
                  next[i] * kLoneBristles.stiffness * joints[i].inertia / (kStep * kStep),
                  100 * rounding);
      sliding += steps[i].sliding;
    }
    ++slid[sliding];
  }
  for (const int count : slid) EXPECT_GT(count, 20);
}

TEST(InertiaBlock, MultipliesAndSolvesChainsOfAnyLength) {
  // chains of up to eight have products of their own
  RandomStream random({6, 0}, Stream::test);
  for (int n = 1; n <= 10; ++n) {
    const Model m = MustCompile(ChainXml(n));
    const Data d(mj_makeData(m.get()));
    for (int i = 0; i < n; ++i) d->qpos[i] = random.Uniform(-3, 3);
    mj_forward(m.get(), d.get());
    const MatrixXd inertia = InertiaOf(m.get(), d.get());
    const InertiaBlock block(m.get(), 0);
    Eigen::MatrixX2d x(n, 2);
    std::vector<Eigen::Array2d> pairs(n), products(n);
    for (int i = 0; i < n; ++i) {
      x.row(i) << random.Normal(), random.Normal();
      pairs[i] = x.row(i).transpose();
    }
    block.Multiply(d.get(), pairs.data(), products.data());
    block.Solve(d.get(), pairs.data());
    const Eigen::MatrixX2d multiplied = inertia * x, solved = inertia.ldlt().solve(x);
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < 2; ++k) {
        EXPECT_NEAR(products[i][k], multiplied(i, k), 1e-13 * multiplied.norm()) << n;
        EXPECT_NEAR(pairs[i][k], solved(i, k), 1e-10 * solved.norm()) << n;
      }
    }
  }
}

TEST_F(CoupledBristlesOfATree, NeverGiveEnergyForAnyMotionAndLevels) {
  for (std::uint64_t run = 0; run < 200; ++run) {
    RandomStream random({4, run}, Stream::test);
    Pose(random);
    MakeBristles(run % 2 == 0);
    std::vector<double> loads(kJoints, 0.0);
    const double speed = std::pow(10, random.Uniform(-3, 1));
    double moved = 1e-20;  // J at most in a step, and what is nothing
    for (int step = 0; step < 500; ++step) {
      // speeds that fall at once, too, and levels that jump
      for (int i = 0; i < kJoints; ++i) {
        d->qvel[i] = random.Uniform(0, 1) < 0.3 ? 0 : speed * random.Normal();
      }
      std::vector<std::array<double, 2>> level(kJoints);
      for (auto& both : level) both = {random.Uniform(-0.5, 3), random.Uniform(-0.5, 3)};
      const std::vector<BristleStep> steps = Step(loads, level);
      const double before = Energy(loads);
      double work = 0, scale = 0;
      for (int i = 0; i < kJoints; ++i) {
        work += steps[i].force * d->qvel[i] * kStep;
        scale += std::abs(steps[i].force * d->qvel[i] * kStep);
        loads[i] = steps[i].load;
      }
      moved = std::max(moved, scale + before);
      ASSERT_GE(work, Energy(loads) - before - 1e-12 * moved) << "run " << run;
    }
  }
}

TEST_F(CoupledBristlesOfATree, TakeJointsWithoutFrictionAsFree) {
  // a free base in place of the others: the two hold as with the Schur complement
  joints.erase(joints.begin());
  joints.pop_back();
  RandomStream random({5, 0}, Stream::test);
  Pose(random);
  MakeBristles(true);
  VectorXd v(2);
  v << 1e-3, -2e-3;
  d->qvel[1] = v[0];
  d->qvel[2] = v[1];
  const std::vector<BristleStep> steps =
      Step(std::vector<double>(kJoints, 0.0), {kJoints, std::array{100.0, 100.0}});
  const MatrixXd schur = MatrixXd(inertia.inverse().block(1, 1, 2, 2)).inverse();
  const VectorXd force = (kLoneBristles.stiffness + kLoneBristles.damping) / kStep * (schur * v);
  EXPECT_NEAR(steps[1].force, force[0], 1e-12);
  EXPECT_NEAR(steps[2].force, force[1], 1e-12);
}

}  // namespace
}  // namespace warmjoint

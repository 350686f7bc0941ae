// Bristles that the inertia matrix couples, against all ways to hold and slide, and their energy.
#include "sim/plugin/coupled_bristles.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "models/foundation/random_stream.h"
#include "sim/plugin/bristle_shape.h"
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

class CoupledBristlesOfATree : public testing::Test {
 protected:
  CoupledBristlesOfATree() : m(MustCompile(kTree)), d(mj_makeData(m.get())) {
    for (size_t i = 0; i < kJoints; ++i)
      joints.push_back({i, static_cast<int>(i), 0.1 + 0.05 * static_cast<double>(i)});
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
};

TEST_F(CoupledBristlesOfATree, ProjectExactlyHoweverManySlide) {
  RandomStream random({3, 0}, Stream::test);
  std::array<int, kJoints + 1> slid{};
  for (int run = 0; run < 3000; ++run) {
    Pose(random);
    CoupledBristles bristles(m.get(), joints);
    bristles.SetTimestep(kStep, [](size_t) { return 0.0; });
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
    std::vector<BristleStep> steps(kJoints);
    bristles.Step(
        d.get(), loads.data(), [&](size_t i, int side) { return level[i][side > 0]; },
        steps.data());

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

TEST_F(CoupledBristlesOfATree, NeverGiveEnergyForAnyMotionAndLevels) {
  for (std::uint64_t run = 0; run < 200; ++run) {
    RandomStream random({4, run}, Stream::test);
    Pose(random);
    CoupledBristles bristles(m.get(), joints);
    bristles.SetTimestep(kStep, [](size_t) { return 0.0; });
    std::vector<double> loads(kJoints, 0.0);
    std::vector<BristleStep> steps(kJoints);
    const double speed = std::pow(10, random.Uniform(-3, 1));
    double moved = 1e-20;  // J at most in a step, and what is nothing
    for (int step = 0; step < 500; ++step) {
      // speeds that fall at once, too, and levels that jump
      for (int i = 0; i < kJoints; ++i) {
        d->qvel[i] = random.Uniform(0, 1) < 0.3 ? 0 : speed * random.Normal();
      }
      std::vector<std::array<double, 2>> level(kJoints);
      for (auto& both : level) both = {random.Uniform(-0.5, 3), random.Uniform(-0.5, 3)};
      bristles.Step(
          d.get(), loads.data(), [&](size_t i, int side) { return level[i][side > 0]; },
          steps.data());
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
  CoupledBristles bristles(m.get(), joints);
  bristles.SetTimestep(kStep, [](size_t) { return 0.0; });
  std::vector<double> loads(kJoints, 0.0);
  std::vector<BristleStep> steps(kJoints);
  VectorXd v(2);
  v << 1e-3, -2e-3;
  d->qvel[1] = v[0];
  d->qvel[2] = v[1];
  bristles.Step(
      d.get(), loads.data(), [](size_t, int) { return 100.0; }, steps.data());
  const MatrixXd schur = MatrixXd(inertia.inverse().block(1, 1, 2, 2)).inverse();
  const VectorXd force = (kLoneBristles.stiffness + kLoneBristles.damping) / kStep * (schur * v);
  EXPECT_NEAR(steps[1].force, force[0], 1e-12);
  EXPECT_NEAR(steps[2].force, force[1], 1e-12);
}

}  // namespace
}  // namespace warmjoint

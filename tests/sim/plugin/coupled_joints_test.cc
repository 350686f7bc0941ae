// Joints that the inertia matrix couples: against all ways to hold and slide, and in several instances.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "models/foundation/random_stream.h"
#include "sim/model/friction_actuator.h"
#include "sim/model/load_model.h"
#include "sim/plugin/friction_instance.h"
#include "sim/plugin/stability.h"
#include "tests/sim/plugin/friction_models.h"

namespace warmjoint {
namespace {

using namespace test;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStep = 0.002;     // s
constexpr double kLoadGain = 0.05;  // of every other joint, whose level then costs much
constexpr double kPerStep = kLoneBristles.stiffness / (kStep * kStep);  // A/h^2

/// A tree of four hinges, two of them on the same link.
constexpr char kTree[] = R"(
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
  </body>)";

/// A chain of so many hinges without branches.
std::string ChainBodies(int joints) {
  std::string bodies, ends;
  const char* axes[] = {"0 0 1", "0 1 0", "1 0 0"};
  for (int i = 0; i < joints; ++i) {
    bodies += fmt::format(R"(<body pos=".2 0 0"><joint name="j{}" axis="{}"/>
        <geom type="capsule" fromto="0 0 0 .2 0 .05" size=".03"/>)",
                          i, axes[i % 3]);
    ends += "</body>";
  }
  return bodies + ends;
}

/// Bodies with friction on some joints, whose levels are set between two steps.
class CoupledJoints {
 public:
  CoupledJoints(const std::string& bodies, const std::vector<int>& joints, int asking)
      : joints_(joints) {
    std::string frictions, data;
    for (const int joint : joints) {
      // every other one has a level that follows its load
      const double gain = joint % 2 == asking ? kLoadGain : 0;
      frictions += fmt::format(R"({}"j{}": {{"law": "asymmetric", "load_gain": {}, "parameters":
          {{"viscous": 0, "coulomb_positive": 1, "coulomb_negative": 1}}}})",
                               frictions.empty() ? "" : ", ", joint, gain);
      gain_.push_back(gain);
      data += "1 ";
    }
    const std::string size = std::to_string(joints.size());
    m = MustCompile(fmt::format(R"(<mujoco><option timestep="{}"/>
      <extension><plugin plugin="warmjoint.friction"><instance name="f">
        <config key="joints" value='{{{}}}'/></instance></plugin></extension>
      <custom><numeric name="f/coulomb_negative" size="{}" data="{}"/>
        <numeric name="f/coulomb_positive" size="{}" data="{}"/></custom>
      <worldbody>{}</worldbody></mujoco>)",
                                kStep, frictions, size, data, size, data, bodies));
    d.reset(mj_makeData(m.get()));
  }

  /// One step from these loads of the bristles, [joints] N.m. levels: {L-, L+} of each, without load.
  void Step(const std::vector<double>& loads, const std::vector<std::array<double, 2>>& levels) {
    const size_t n = joints_.size();
    mjtNum* states = d->plugin_state + m->plugin_stateadr[0] + kFrictionReports;
    for (size_t k = 0; k < n; ++k) {
      states[2 * k] = loads[k];
      for (size_t side = 0; side < 2; ++side) m->numeric_data[side * n + k] = levels[k][side];
    }
    mj_step(m.get(), d.get());
    // all of the step's own pose
    force = next = VectorXd(n);
    level = levels;
    for (size_t k = 0; k < n; ++k) {
      force[k] = -d->qfrc_passive[joints_[k]];
      next[k] = states[2 * k];
      const double growth = gain_[k] * std::abs(d->qfrc_bias[joints_[k]]);
      for (double& one : level[k]) one += growth;
    }
    inertia.resize(m->nv, m->nv);
    mj_fullM(m.get(), d.get(), inertia.data());
  }

  double Inertia(size_t k) const { return EffectiveInertia(m.get(), joints_[k]); }

  Model m;
  Data d;
  // of the last step
  VectorXd force, next;                      // [joints] N.m
  std::vector<std::array<double, 2>> level;  // with the load's part
  MatrixXd inertia;                          // [nv x nv]

 private:
  std::vector<int> joints_;
  std::vector<double> gain_;
};

/// The projection by trying all sets of what is at a bound, which go to `sliding`.
VectorXd Project(const MatrixXd& inertia, const VectorXd& aim,
                 const std::vector<std::array<double, 2>>& level, std::vector<int>* sliding) {
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
    if (right) {
      *sliding = slides;
      return force;
    }
  }
  ADD_FAILURE() << "no set is right";
  return aim;
}

TEST(PluginCoupledJoints, ProjectExactlyHoweverManySlide) {
  RandomStream random({3, 0}, Stream::test);
  constexpr int n = 4;
  CoupledJoints arms[] = {{kTree, {0, 1, 2, 3}, 0}, {kTree, {0, 1, 2, 3}, 1}};
  std::array<int, n + 1> slid{};
  for (int run = 0; run < 3000; ++run) {
    CoupledJoints& arm = arms[run % 2];
    std::vector<std::array<double, 2>> levels(n);
    std::vector<double> loads(n);
    VectorXd v(n), stretch(n);
    const double speed = std::pow(10, random.Uniform(-4, 1.5));
    for (int i = 0; i < n; ++i) {
      arm.d->qpos[i] = random.Uniform(-3, 3);
      levels[i] = {random.Uniform(0, 3), random.Uniform(0, 3)};
      loads[i] = random.Uniform(-2, 2);
      v[i] = arm.d->qvel[i] = speed * random.Normal();
      stretch[i] = loads[i] / (kPerStep * arm.Inertia(i));
    }
    arm.Step(loads, levels);

    // twice, with double levels for what the first holds, and the stretch that it leaves
    const VectorXd spring = kPerStep * (arm.inertia * (stretch + kStep * v));
    std::vector<int> sliding, unused;
    const VectorXd elastic = Project(arm.inertia, spring, arm.level, &sliding);
    std::vector<std::array<double, 2>> wide = arm.level;
    for (int i = 0; i < n; ++i) {
      if (std::ranges::find(sliding, i) != sliding.end()) continue;
      for (double& level : wide[i]) level *= 2;
    }
    const VectorXd damping = kLoneBristles.damping / kStep * (arm.inertia * v);
    const VectorXd force = Project(arm.inertia, elastic + damping, wide, &unused);
    const VectorXd next = arm.inertia.ldlt().solve(elastic);
    // rounding of what is projected
    const double rounding = 1e-12 * (spring.norm() + damping.norm() + 1);
    for (int i = 0; i < n; ++i) {
      ASSERT_NEAR(arm.force[i], force[i], rounding) << "run " << run;
      ASSERT_NEAR(arm.next[i], next[i] * arm.Inertia(i), 100 * rounding) << "run " << run;
    }
    ++slid[sliding.size()];
  }
  for (const int count : slid) EXPECT_GT(count, 20);
}

TEST(PluginCoupledJoints, HoldAndSlideInChainsOfAnyLength) {
  // chains of up to eight have products of their own
  RandomStream random({6, 0}, Stream::test);
  for (int n = 1; n <= 10; ++n) {
    std::vector<int> joints(n);
    for (int i = 0; i < n; ++i) joints[i] = i;
    CoupledJoints arm(ChainBodies(n), joints, -1);
    for (const bool slides : {false, true}) {
      VectorXd v(n), side(n);
      for (int i = 0; i < n; ++i) {
        arm.d->qpos[i] = random.Uniform(-3, 3);
        v[i] = arm.d->qvel[i] = random.Normal() < 0 ? -1 : 1;
        side[i] = 1e-6 * v[i];
        if (!slides) v[i] = arm.d->qvel[i] = 1e-6 * v[i];
      }
      arm.Step(std::vector<double>(n, 0.0), {size_t(n), {slides ? 1e-6 : 3, slides ? 1e-6 : 3}});
      // held as one spring and damper of the shape of M; sliding at the levels, which bristles carry
      const VectorXd spring = kPerStep * kStep * (arm.inertia * v);
      const VectorXd held = spring + kLoneBristles.damping / kStep * (arm.inertia * v);
      const VectorXd force = slides ? side : held;
      const VectorXd next =
          slides ? VectorXd(arm.inertia.ldlt().solve(side)) : VectorXd(kPerStep * kStep * v);
      for (int i = 0; i < n; ++i) {
        EXPECT_NEAR(arm.force[i], force[i], 1e-12 * force.norm()) << n << " joints";
        EXPECT_NEAR(arm.next[i], next[i] * arm.Inertia(i), 1e-9 * next.norm()) << n << " joints";
      }
    }
  }
}

TEST(PluginCoupledJoints, TakeJointsWithoutFrictionAsFree) {
  // the two hold as with the Schur complement of the others
  RandomStream random({5, 0}, Stream::test);
  CoupledJoints arm(kTree, {1, 2}, -1);
  for (int i = 0; i < 4; ++i) arm.d->qpos[i] = random.Uniform(-3, 3);
  VectorXd v(2);
  v << 1e-3, -2e-3;
  arm.d->qvel[1] = v[0];
  arm.d->qvel[2] = v[1];
  arm.Step({0, 0}, {2, {3, 3}});
  const MatrixXd schur = MatrixXd(arm.inertia.inverse().block(1, 1, 2, 2)).inverse();
  const VectorXd force = (kLoneBristles.stiffness + kLoneBristles.damping) / kStep * (schur * v);
  EXPECT_NEAR(arm.force[0], force[0], 1e-12);
  EXPECT_NEAR(arm.force[1], force[1], 1e-12);
}

/// Two links, the second beside the first or on its end.
constexpr char kTwoLinks[] = R"(
<mujoco>
  <option timestep="0.001" integrator="implicitfast"><flag contact="disable"/></option>
  <worldbody>
    <body>
      <joint name="shoulder" axis="0 1 0"/>
      <geom type="capsule" fromto="0 0 0 0.4 0 0" size="0.04" mass="2"/>
      {}
        <joint name="elbow" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.04" mass="1"/>
      </body>
    {}
  </worldbody>
</mujoco>)";

Friction Shoulder(double level = 3) { return {"coulomb", {{"coulomb", level}}, Thermal{-0.2, 5}}; }

/// Another law, with another number of states, that drives the joint once warm.
Friction Elbow() {
  return {"stiction", {{"viscous", 0.1}, {"coulomb", 0.5}, {"static", 0.7}}, Thermal{-3, 0.2}};
}

enum class Second { beside, on_the_end };

/// The model with the frictions added in these groups, each of which shares an instance.
ModelPtr TwoLinks(Second second, const std::vector<std::vector<FrictionForJoint>>& groups) {
  const bool beside = second == Second::beside;
  const SpecPtr spec = ParseXml(
      fmt::format(kTwoLinks, beside ? R"(</body><body pos="0 1 0">)" : R"(<body pos="0.4 0 0">)",
                  beside ? "" : "</body>"));
  for (const auto& group : groups) AddFriction(*spec, group, {"test"});
  return CompileModel(*spec, {"test"});
}

std::vector<double> Fall(const mjModel* m, mjData* d) {
  while (d->time < 2) mj_step(m, d);
  std::vector<double> state(d->qpos, d->qpos + m->nq);
  state.insert(state.end(), d->qvel, d->qvel + m->nv);
  state.insert(state.end(), d->act, d->act + m->na);
  return state;
}

TEST(PluginJoints, OfTwoTreesMoveInOneInstanceAsInInstancesOfTheirOwn) {
  const FrictionForJoint shoulder{"shoulder", Shoulder()}, elbow{"elbow", Elbow()};
  const ModelPtr shared = TwoLinks(Second::beside, {{shoulder, elbow}});
  const ModelPtr own = TwoLinks(Second::beside, {{shoulder}, {elbow}});
  ASSERT_EQ(shared->nplugin, 1);
  ASSERT_EQ(own->nplugin, 2);

  const Warnings warnings;
  const DataPtr a(mj_makeData(shared.get())), b(mj_makeData(own.get()));
  const std::vector<double> state = Fall(shared.get(), a.get());
  EXPECT_EQ(state, Fall(own.get(), b.get()));
  EXPECT_LT(state[5], -0.1) << "the shoulder should be warm";

  // the elbow alone left its law's domain: bit 1 of the shared instance, bit 0 of its own
  EXPECT_EQ(a->plugin_state[shared->plugin_stateadr[0] + kReportsPush], 2);
  EXPECT_EQ(b->plugin_state[own->plugin_stateadr[0] + kReportsPush], 0);
  EXPECT_EQ(b->plugin_state[own->plugin_stateadr[1] + kReportsPush], 1);
}

/// How far the shoulder gives way when the links' weight sets in slowly, rad.
double Give(const mjModel* model) {
  const ModelPtr m(mj_copyModel(nullptr, model));
  const DataPtr d(mj_makeData(m.get()));
  while (d->time < 2) {
    m->opt.gravity[2] = -9.81 * std::min(1.0, d->time);
    mj_step(m.get(), d.get());
  }
  EXPECT_LT(std::abs(d->qvel[0]), 1e-9);
  return std::abs(d->qpos[0]);
}

TEST(PluginJoints, OfOneTreeGiveWayByMoreInInstancesOfTheirOwn) {
  const FrictionForJoint shoulder{"shoulder", Shoulder(20)}, elbow{"elbow", Shoulder(20)};
  const ModelPtr shared = TwoLinks(Second::on_the_end, {{shoulder, elbow}});
  const ModelPtr own = TwoLinks(Second::on_the_end, {{shoulder}, {elbow}});
  // by the ratio of stiffnesses, and by more, since an instance holds what the other's joint leaves of the inertia
  const double softer = kLoneBristles.stiffness / BristlesOf(2).stiffness;
  EXPECT_GT(Give(own.get()), softer * Give(shared.get()));
  EXPECT_LT(Give(own.get()), 0.001);
}

/// A chain of links, each joint with friction from an instance of its own.
ModelPtr Chain(int links) {
  std::string bodies, ends;
  for (int i = 0; i < links; ++i) {
    bodies += fmt::format(R"(<body pos="{} 0 0"><joint name="j{}" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 0.1 0 0" size="0.02" mass="{}"/>)",
                          i == 0 ? 0 : 0.1, i, 1 - 0.1 * i);
    ends += "</body>";
  }
  const SpecPtr spec = ParseXml(fmt::format(
      R"(<mujoco><option timestep="0.001" gravity="0 0 -1"><flag contact="disable"/></option>
         <worldbody>{}{}</worldbody></mujoco>)",
      bodies, ends));
  for (int i = 0; i < links; ++i) {
    AddFriction(*spec, {{fmt::format("j{}", i), Shoulder(2)}}, {"test"});
  }
  return CompileModel(*spec, {"test"});
}

TEST(PluginJoints, OfOneTreeAreStableInAnyNumberOfInstances) {
  for (const int links : {2, 3, 4, 5, 6}) {
    const ModelPtr m = Chain(links);
    ASSERT_EQ(m->nplugin, links);
    const DataPtr d(mj_makeData(m.get()));
    for (int i = 0; i < links; ++i) d->qpos[i] = 0.3 * i;
    // coupled modes of five and more decay slowest
    while (d->time < 30) mj_step(m.get(), d.get());
    for (int i = 0; i < links; ++i) EXPECT_LT(std::abs(d->qvel[i]), 1e-9) << links << " links";
  }
}

}  // namespace
}  // namespace warmjoint

// Several joints that share one instance of the plugin.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/model/friction_actuator.h"
#include "sim/model/load_model.h"
#include "sim/plugin/friction_instance.h"
#include "tests/sim/plugin/friction_models.h"
#include "tests/sim/plugin/warnings.h"

namespace warmjoint {
namespace {

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

Friction Shoulder() {
  Friction friction;
  friction.law = "coulomb";
  friction.parameters = {{"coulomb", 3}};
  friction.thermal = Thermal{-0.2, 5};
  return friction;
}

/// Another law, with another number of states, that feeds itself once warm.
Friction Elbow() {
  Friction friction;
  friction.law = "stiction";
  friction.parameters = {{"viscous", 0.1}, {"coulomb", 0.5}, {"static", 0.7}};
  friction.thermal = Thermal{-3, 0.2};
  return friction;
}

enum class Second { beside, on_the_end };

/// The model with the frictions added in these groups, each of which shares an instance.
ModelPtr TwoLinks(Second second, const std::vector<std::vector<FrictionForJoint>>& groups) {
  const bool beside = second == Second::beside;
  const std::string xml =
      fmt::format(kTwoLinks, beside ? R"(</body><body pos="0 1 0">)" : R"(<body pos="0.4 0 0">)",
                  beside ? "" : "</body>");
  char error[500] = "";
  const SpecPtr spec(mj_parseXMLString(xml.c_str(), nullptr, error, sizeof(error)));
  EXPECT_TRUE(spec) << error;
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

  const test::Warnings warnings;
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
  FrictionForJoint shoulder{"shoulder", Shoulder()}, elbow{"elbow", Shoulder()};
  shoulder.friction.parameters["coulomb"] = elbow.friction.parameters["coulomb"] = 20;
  const ModelPtr shared = TwoLinks(Second::on_the_end, {{shoulder, elbow}});
  const ModelPtr own = TwoLinks(Second::on_the_end, {{shoulder}, {elbow}});
  // 0.8 / 0.6, and by more, since an instance holds what the other's joint leaves of the inertia
  EXPECT_GT(Give(own.get()), 0.8 / 0.6 * Give(shared.get()));
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
  char error[500] = "";
  const SpecPtr spec(mj_parseXMLString(
      fmt::format(
          R"(<mujoco><option timestep="0.001" gravity="0 0 -1"><flag contact="disable"/></option>
                     <worldbody>{}{}</worldbody></mujoco>)",
          bodies, ends)
          .c_str(),
      nullptr, error, sizeof(error)));
  EXPECT_TRUE(spec) << error;
  for (int i = 0; i < links; ++i) {
    FrictionForJoint friction{fmt::format("j{}", i), Shoulder()};
    friction.friction.parameters["coulomb"] = 2;
    AddFriction(*spec, {friction}, {"test"});
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

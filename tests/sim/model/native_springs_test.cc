#include "sim/model/native_springs.h"

#include <gtest/gtest.h>
#include <warmjoint/attach.h>

#include <string>

#include "models/foundation/bad_input.h"
#include "sim/model/spec_elements.h"

namespace warmjoint {
namespace {

SpecPtr Arm(const std::string& joint = "") {
  const std::string link =
      "<geom type='capsule' size='.03' fromto='0 0 0 0 0 -.3' mass='1' contype='0' "
      "conaffinity='0'/>";
  const std::string text =
      "<mujoco><option timestep='.001' integrator='Euler'/><worldbody><body><joint name='a' "
      "axis='0 1 0' " +
      joint + "/>" + link + "<body pos='0 0 -.3'><joint name='b' axis='0 1 0'/>" + link +
      "</body></body></worldbody><actuator><position joint='b' kp='2e5' "
      "kv='1'/></actuator></mujoco>";
  return SpecPtr(mj_parseXMLString(text.c_str(), nullptr, nullptr, 0));
}

Friction Plain() {
  return {"viscous_coulomb", {{"viscous", 1}, {"coulomb", 4}}, Thermal{-0.1, 60}};
}

AttachOptions Native() { return {.form = FrictionForm::native}; }

TEST(NativeSprings, HoldTheLevelWithoutAPlugin) {
  const SpecPtr spec = Arm();
  const Attached attached =
      AttachFriction(*spec, {{"a", Plain(), {-1.0}}, {"b", Plain()}}, Native(), "arm");
  const ModelPtr m(mj_compile(spec.get(), nullptr));
  ASSERT_TRUE(m);
  EXPECT_EQ(m->nplugin, 0);
  ASSERT_EQ(attached.springs.size(), 2u);
  // the level with the heat at the start, and as stiff as the stiffest mode of both allows
  const double levels[] = {3, 4};
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(m->jnt_stiffness[i] * m->jnt_springyield[i], levels[i], 1e-9);
    EXPECT_EQ(m->dof_damping[i], 1);
    EXPECT_EQ(m->jnt_stiffness[i], attached.springs[static_cast<size_t>(i)].stiffness);
  }
  const int tuple = mj_name2id(m.get(), mjOBJ_TUPLE, "native");
  ASSERT_GE(tuple, 0);
  EXPECT_EQ(m->tuple_size[tuple], 2);
  EXPECT_GE(mj_name2id(m.get(), mjOBJ_NUMERIC, "native/thermal_gain"), 0);
}

TEST(NativeSprings, RefuseWhatTheyCannotHoldUnlessItIsReplaced) {
  const Friction stiction{"stiction", {{"viscous", 1}, {"coulomb", 3}, {"static", 4}}, {}};
  AttachOptions options = Native();
  EXPECT_THROW(AttachFriction(*Arm(), {{"a", stiction}}, options, "arm"), BadInput);
  options.approximate = true;
  const Attached attached = AttachFriction(*Arm(), {{"a", stiction}}, options, "arm");
  EXPECT_EQ(attached.springs.front().friction.friction.law, "viscous_coulomb");
  EXPECT_EQ(attached.notices.size(), 1u);
  // a spring of the joint's own, and a step that lets it give way too far
  EXPECT_THROW(AttachFriction(*Arm("stiffness='2'"), {{"a", Plain()}}, options, "arm"), BadInput);
  options.timestep = 0.1;
  EXPECT_THROW(AttachFriction(*Arm(), {{"a", Plain()}}, options, "arm"), BadInput);
}

TEST(IntegratorChoice, TakesImplicitfastBesideStiffServosAlone) {
  AttachOptions options{.form = FrictionForm::passive,
                        .integrator_choice = IntegratorChoice::automatic};
  const SpecPtr stiff = Arm();
  mjs_asActuator(mjs_firstElement(stiff.get(), mjOBJ_ACTUATOR))->gainprm[0] = 100;
  mjs_asActuator(mjs_firstElement(stiff.get(), mjOBJ_ACTUATOR))->biasprm[1] = -100;
  mjs_asActuator(mjs_firstElement(stiff.get(), mjOBJ_ACTUATOR))->biasprm[2] = -60;
  AttachFriction(*stiff, {{"a", Plain()}, {"b", Plain()}}, options, "arm");
  EXPECT_EQ(stiff->option.integrator, mjINT_IMPLICITFAST);
  const SpecPtr soft = Arm();
  mjs_asActuator(mjs_firstElement(soft.get(), mjOBJ_ACTUATOR))->gainprm[0] = 10;
  mjs_asActuator(mjs_firstElement(soft.get(), mjOBJ_ACTUATOR))->biasprm[1] = -10;
  AttachFriction(*soft, {{"a", Plain()}, {"b", Plain()}}, options, "arm");
  EXPECT_EQ(soft->option.integrator, mjINT_EULER);
}

}  // namespace
}  // namespace warmjoint

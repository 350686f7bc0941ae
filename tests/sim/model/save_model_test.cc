#include "sim/model/load_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/model/spec_elements.h"

namespace warmjoint {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr char kModel[] = R"(<mujoco>
  <compiler angle="degree" eulerseq="zyx"/>
  <option timestep="0.0012345678901234"/>
  <default><default class="thin"><geom size="0.0123456789012345"/></default></default>
  <worldbody>
    <frame pos="0.1 0.2 0.3">
      <body euler="10.123456789 20 30" pos="0.333333333333333333 1e-7 0">
        <joint name="j" range="-33.3333333333 77"/>
        <geom class="thin" type="capsule" fromto="0 0 0 0.1 0.2 0.3" mass="1.2345678901234567"/>
      </body>
    </frame>
  </worldbody>
  <actuator><position joint="j" kp="12.3456789012345"/></actuator>
  <keyframe><key qpos="0.12345678901234567"/></keyframe>
</mujoco>)";

SpecPtr Parse(const std::string& text) {
  char error[300] = "";
  SpecPtr spec(mj_parseXMLString(text.c_str(), nullptr, error, sizeof(error)));
  EXPECT_TRUE(spec) << error;
  return spec;
}

TEST(ModelToXml, KeepsEveryBit) {
  const SpecPtr spec = Parse(kModel);
  const ModelPtr a(mj_compile(spec.get(), nullptr));
  const SpecPtr again = Parse(ModelToXml(*spec, {}));
  const ModelPtr b(mj_compile(again.get(), nullptr));
  EXPECT_EQ(a->opt.timestep, b->opt.timestep);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(a->body_pos[3 + i], b->body_pos[3 + i]);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(a->body_iquat[4 + i], b->body_iquat[4 + i]);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(a->body_inertia[3 + i], b->body_inertia[3 + i]);
  EXPECT_EQ(a->body_mass[1], b->body_mass[1]);
  EXPECT_EQ(a->jnt_range[0], b->jnt_range[0]);
  EXPECT_EQ(a->actuator_gainprm[0], b->actuator_gainprm[0]);
  EXPECT_EQ(a->key_qpos[0], b->key_qpos[0]);
  EXPECT_EQ(a->geom_size[1], b->geom_size[1]);
}

TEST(ModelToXml, KeepsTheNotationOfTheModel) {
  const std::string text = ModelToXml(*Parse(kModel), {});
  EXPECT_THAT(text, AllOf(HasSubstr("euler="), HasSubstr("fromto="), HasSubstr("<position"),
                          HasSubstr("class=\"thin\""), HasSubstr("<frame")));
  EXPECT_THAT(text, Not(HasSubstr("<general")));
}

}  // namespace
}  // namespace warmjoint

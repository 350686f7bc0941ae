// Numbers of friction in arrays of the model, which may change between steps and between worlds.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/sim/plugin/two_forms.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using namespace test;

constexpr int kWorlds = 64;

Friction Law(double positive, double viscous, double gain) {
  return {"asymmetric",
          {{"viscous", viscous}, {"coulomb_positive", positive}, {"coulomb_negative", 0.9}},
          Thermal{gain, 3}};
}

std::string WithArrays(std::string xml, const std::string& arrays) {
  return xml.insert(xml.rfind("</mujoco>"), "<custom>" + arrays + "</custom>");
}

constexpr char kArrays[] = R"(
  <numeric name="arm/coulomb_positive" size="3" data="0.7 0.7 0.7"/>
  <numeric name="arm/viscous" size="3" data="0.1 0.1 0.1"/>
  <numeric name="arm/thermal_gain" size="3" data="-0.02 -0.02 -0.02"/>)";

/// The state but for its last number, which tells the attributes.
std::vector<mjtNum> StateButMark(const Model& m, const Data& d) {
  std::vector<mjtNum> state = FullState(m.get(), d.get());
  state.pop_back();
  return state;
}

/// Numbers in arrays, which change between two steps, beside the same ones in the attributes.
void ExpectAlike(const Model& arrays, const std::vector<double>& numbers, const Model& text,
                 const Data& a, const Data& b) {
  for (size_t i = 0; i < numbers.size(); ++i) {
    std::fill_n(arrays->numeric_data + arrays->numeric_adr[i], kArmJoints, numbers[i]);
  }
  DriveArm(arrays.get(), a.get(), 700);
  DriveArm(text.get(), b.get(), 700);
  EXPECT_EQ(StateButMark(arrays, a), StateButMark(text, b));
}

TEST(PluginNumbers, InArraysActAsTheSameInTheAttributes) {
  for (const Form form : {Form::actuator, Form::passive}) {
    const Model first = MustCompile(ArmXml(Law(0.7, 0.1, -0.02), form, "implicitfast"));
    const Model second = MustCompile(ArmXml(Law(0.5, 0.3, -0.05), form, "implicitfast"));
    const Model arrays =
        MustCompile(WithArrays(ArmXml(Law(0.7, 0.1, -0.02), form, "implicitfast"), kArrays));
    const Data a(mj_makeData(arrays.get())), b(mj_makeData(second.get()));
    ExpectAlike(arrays, {0.5, 0.3, -0.05}, second, a, b);
    ExpectAlike(arrays, {0.7, 0.1, -0.02}, first, a, b);

    // of the load, too, where the attributes' number acts for one out of its bounds
    Friction friction = Law(0.3, 0.1, -0.02);
    friction.load_gain = 0.05;
    const Model load =
        MustCompile(WithArrays(ArmXml(friction, form, "implicitfast"),
                               R"(<numeric name="arm/load_gain" size="3" data="0.2 0.2 0.2"/>)"));
    friction.load_gain = 0.2;
    const Model text = MustCompile(ArmXml(friction, form, "implicitfast"));
    const Data c(mj_makeData(load.get())), d(mj_makeData(text.get()));
    ExpectAlike(load, {0.2}, text, c, d);
    friction.load_gain = 0.05;
    const Model given = MustCompile(ArmXml(friction, form, "implicitfast"));
    const Warnings warnings;
    for (const double out : {-1.0, std::nan(""), kInfinity}) {
      mj_resetData(load.get(), c.get());
      const Data e(mj_makeData(given.get()));
      ExpectAlike(load, {out}, given, c, e);
    }
    // told once, by its name
    EXPECT_EQ(Warnings::text().find("numeric 'arm/load_gain' of joint 'j0' is -1; it must be"),
              std::string("warmjoint.friction: ").size());
    EXPECT_EQ(Warnings::text().find("nan"), std::string::npos);
    ExpectNamed(Warnings::text(), {"joint 'j2'", "of at least 0", "0.05 acts instead"});
  }
}

TEST(PluginNumbers, RandomisedOverABatchEqualSingleRunsBitForBit) {
  for (const Form form : {Form::actuator, Form::passive}) {
    const Model m =
        MustCompile(WithArrays(ArmXml(Law(0.7, 0.1, -0.02), form, "implicitfast"), kArrays));
    const Batch batch = MakeBatch(m.get(), kWorlds, 4);
    int size = 0;
    auto* numbers = static_cast<mjtNum*>(mjb_expand(batch.get(), "numeric_data", &size, nullptr));
    ASSERT_TRUE(numbers);
    ASSERT_EQ(size, 9);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> factor(0.5, 1.5);
    for (int i = 0; i < kWorlds * size; ++i) numbers[i] *= factor(random);

    std::vector<mjtNum> controls;
    for (int i = 0; i < 200; ++i) {
      for (int k = 0; k < m->nu; ++k) controls.push_back(k < kArmJoints ? 3 - k : 0);
    }
    RollOut(batch.get(), kWorlds, 200, controls);
    const Data of_batch(mj_makeData(m.get()));
    for (int world = 0; world < kWorlds; ++world) {
      const Model single(mj_copyModel(nullptr, m.get()));
      std::copy_n(numbers + world * size, size, single->numeric_data);
      const Data d(mj_makeData(single.get()));
      for (int i = 0; i < 200; ++i) {
        for (int k = 0; k < kArmJoints; ++k) d->ctrl[k] = 3 - k;
        mj_step(single.get(), d.get());
      }
      mjb_getData(batch.get(), world, of_batch.get());
      EXPECT_EQ(FullState(m.get(), of_batch.get()), FullState(m.get(), d.get())) << world;
    }
  }
}

TEST(PluginNumbers, BeyondWhatTheStepBearsWarn) {
  const Model m =
      MustCompile(WithArrays(ArmXml(Law(0.7, 0.1, -0.02), Form::passive, "implicitfast"), kArrays));
  const Data d(mj_makeData(m.get()));
  const Warnings warnings;
  mj_step(m.get(), d.get());
  EXPECT_EQ(Warnings::text(), "");
  m->numeric_data[3] = 1e4;
  mj_step(m.get(), d.get());
  ExpectNamed(Warnings::text(), {"joint 'j0'", "1e+04", "timestep of at most"});
}

}  // namespace
}  // namespace warmjoint

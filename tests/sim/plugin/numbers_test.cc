// Numbers of friction in arrays of the model, which may change between steps and between worlds.
#include <gmock/gmock.h>
#include <mujoco/mjbatch.h>

#include <memory>
#include <random>

#include "tests/sim/plugin/two_forms.h"
#include "tests/sim/plugin/warnings.h"

namespace warmjoint {
namespace {

using namespace test;
using ::testing::HasSubstr;

constexpr int kWorlds = 64;

struct DeleteBatch {
  void operator()(mjBatch* batch) const { mjb_deleteBatch(batch); }
};

Friction Law(double positive, double viscous, double gain) {
  Friction friction;
  friction.law = "asymmetric";
  friction.parameters = {
      {"viscous", viscous}, {"coulomb_positive", positive}, {"coulomb_negative", 0.9}};
  friction.thermal = Thermal{gain, 3};
  return friction;
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

TEST(PluginNumbers, InArraysActAsTheSameInTheAttributes) {
  for (const Form form : {Form::actuator, Form::passive}) {
    const Model arrays =
        MustCompile(WithArrays(ArmXml(Law(0.7, 0.1, -0.02), form, "implicitfast"), kArrays));
    const Model text = MustCompile(ArmXml(Law(0.5, 0.3, -0.05), form, "implicitfast"));
    const double numbers[] = {0.5, 0.3, -0.05};
    for (int i = 0; i < 3; ++i) {
      std::fill_n(arrays->numeric_data + arrays->numeric_adr[i], 3, numbers[i]);
    }
    const Data a(mj_makeData(arrays.get())), b(mj_makeData(text.get()));
    DriveArm(arrays.get(), a.get(), 1000);
    DriveArm(text.get(), b.get(), 1000);
    EXPECT_EQ(StateButMark(arrays, a), StateButMark(text, b));

    // and back, between two steps
    const Model first = MustCompile(ArmXml(Law(0.7, 0.1, -0.02), form, "implicitfast"));
    const double before[] = {0.7, 0.1, -0.02};
    for (int i = 0; i < 3; ++i) {
      std::fill_n(arrays->numeric_data + arrays->numeric_adr[i], 3, before[i]);
    }
    DriveArm(arrays.get(), a.get(), 500);
    DriveArm(first.get(), b.get(), 500);
    EXPECT_EQ(StateButMark(arrays, a), StateButMark(first, b));
  }
}

TEST(PluginNumbers, OfTheLoadInAnArrayActAsTheSameInTheAttributes) {
  for (const Form form : {Form::actuator, Form::passive}) {
    Friction friction = Law(0.3, 0.1, -0.02);
    friction.load_gain = 0.05;
    const Model array =
        MustCompile(WithArrays(ArmXml(friction, form, "implicitfast"),
                               R"(<numeric name="arm/load_gain" size="3" data="0.2 0.2 0.2"/>)"));
    friction.load_gain = 0.2;
    const Model text = MustCompile(ArmXml(friction, form, "implicitfast"));
    const Data a(mj_makeData(array.get())), b(mj_makeData(text.get()));
    DriveArm(array.get(), a.get(), 500);
    DriveArm(text.get(), b.get(), 500);
    EXPECT_EQ(StateButMark(array, a), StateButMark(text, b));

    // a gain below 0 is out of its bounds and leaves the one before
    std::fill_n(array->numeric_data, 3, -1.0);
    DriveArm(array.get(), a.get(), 100);
    DriveArm(text.get(), b.get(), 100);
    EXPECT_EQ(StateButMark(array, a), StateButMark(text, b));
  }
}

TEST(PluginNumbers, RandomisedOverABatchEqualSingleRunsBitForBit) {
  for (const Form form : {Form::actuator, Form::passive}) {
    const Model m =
        MustCompile(WithArrays(ArmXml(Law(0.7, 0.1, -0.02), form, "implicitfast"), kArrays));
    mjBatchConfig config;
    mjb_defaultConfig(&config);
    config.nthread = 4;
    char error[500] = "";
    const std::unique_ptr<mjBatch, DeleteBatch> batch(
        mjb_makeBatch(m.get(), kWorlds, &config, error, sizeof(error)));
    ASSERT_TRUE(batch) << error;
    int size = 0;
    auto* numbers = static_cast<mjtNum*>(mjb_expand(batch.get(), "numeric_data", &size, nullptr));
    ASSERT_TRUE(numbers);
    ASSERT_EQ(size, 9);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> factor(0.5, 1.5);
    for (int i = 0; i < kWorlds * size; ++i) numbers[i] *= factor(random);

    ASSERT_EQ(mjb_reset(batch.get(), nullptr, kWorlds, nullptr, mjSTAGE_NONE), 0);
    std::vector<mjtNum> controls;
    for (int world = 0; world < kWorlds; ++world) {
      for (int i = 0; i < 200; ++i) {
        for (int k = 0; k < m->nu; ++k) controls.push_back(k < kArmJoints ? 3 - k : 0);
      }
    }
    ASSERT_EQ(
        mjb_rollout(batch.get(), nullptr, kWorlds, 200, controls.data(), mjSTATE_CTRL, nullptr, 0),
        0);

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

TEST(PluginNumbers, OutOfTheirBoundsAreNotTaken) {
  const Model m =
      MustCompile(WithArrays(ArmXml(Law(0.7, 0.1, -0.02), Form::passive, "implicitfast"), kArrays));
  const Data d(mj_makeData(m.get())), untouched(mj_makeData(m.get()));
  DriveArm(m.get(), untouched.get(), 300);
  m->numeric_data[0] = -1;
  m->numeric_data[1] = std::nan("");
  DriveArm(m.get(), d.get(), 300);
  EXPECT_EQ(FullState(m.get(), d.get()), FullState(m.get(), untouched.get()));
}

TEST(PluginNumbers, ThatNothingHasOrOfAnotherSizeAreRefused) {
  const auto error = [](const char* array) {
    return Compile(WithArrays(ArmXml(Law(0.7, 0.1, -0.02), Form::passive, "Euler"), array)).error;
  };
  EXPECT_THAT(error(R"(<numeric name="arm/coulomb" size="3"/>)"),
              HasSubstr("numeric 'arm/coulomb': no joint's friction has a number 'coulomb'"));
  EXPECT_THAT(error(R"(<numeric name="arm/viscous" size="2"/>)"),
              HasSubstr("numeric 'arm/viscous': has 2 numbers; give 3"));
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
  EXPECT_THAT(Warnings::text(), HasSubstr("joint 'j0': friction rises by up to 1e+04"));
}

}  // namespace
}  // namespace warmjoint

// States are carried bit for bit in both forms: state vectors, copies, resets, mjb, batches.
#include <gmock/gmock.h>

#include <string>
#include <tuple>
#include <vector>

#include "tests/sim/plugin/two_forms.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

using namespace test;

constexpr int kHalf = 400;  // steps

/// Law, form and integrator.
class CarriageOfStates : public testing::TestWithParam<std::tuple<size_t, Form, const char*>> {
 protected:
  CarriageOfStates()
      : m(MustCompile(ArmXml(FrictionsOfEveryLaw()[std::get<0>(GetParam())],
                             std::get<1>(GetParam()), std::get<2>(GetParam())))),
        d(mj_makeData(m.get())) {
    DriveArm(m.get(), d.get(), kHalf);
    half = FullState(m.get(), d.get());
    copy.reset(mj_copyData(nullptr, m.get(), d.get()));
    DriveArm(m.get(), d.get(), kHalf);
    end = FullState(m.get(), d.get());
  }

  /// The end in that model, from data that was elsewhere.
  std::vector<mjtNum> EndIn(const mjModel* model) const {
    const Data data(mj_makeData(model));
    DriveArm(model, data.get(), 123);
    mj_setState(model, data.get(), half.data(), mjSTATE_FULLPHYSICS);
    // forwards in between change nothing
    mj_forward(model, data.get());
    mj_forward(model, data.get());
    DriveArm(model, data.get(), kHalf);
    return FullState(model, data.get());
  }

  Model m;
  Data d, copy{nullptr};
  std::vector<mjtNum> half, end;
};

TEST_P(CarriageOfStates, IsBitForBitByStateVectorCopyAndReset) {
  EXPECT_EQ(EndIn(m.get()), end);
  DriveArm(m.get(), copy.get(), kHalf);
  EXPECT_EQ(FullState(m.get(), copy.get()), end);
  mj_resetData(m.get(), copy.get());
  DriveArm(m.get(), copy.get(), kHalf);
  EXPECT_EQ(FullState(m.get(), copy.get()), half);
}

TEST_P(CarriageOfStates, IsBitForBitInAModelThatWasSavedAndLoaded) {
  const ScratchDirectory scratch;
  const std::string file = scratch.path() / "arm.mjb";
  mj_saveModel(m.get(), file.c_str(), nullptr, 0);
  const Model loaded(mj_loadModel(file.c_str(), nullptr));
  ASSERT_TRUE(loaded);
  EXPECT_EQ(EndIn(loaded.get()), end);
}

TEST_P(CarriageOfStates, IsBitForBitInABatchOnOneAndFourThreads) {
  constexpr int worlds = 8;
  // controls as DriveArm sets them, from the time at which the step begins
  std::vector<mjtNum> controls;
  const Data single(mj_makeData(m.get()));
  for (int i = 0; i < kHalf; ++i) {
    DriveArm(m.get(), single.get(), 1);
    controls.insert(controls.end(), single->ctrl, single->ctrl + m->nu);
  }
  for (const int threads : {1, 4}) {
    const Batch batch = MakeBatch(m.get(), worlds, threads);
    RollOut(batch.get(), worlds, kHalf, controls);
    const Data of_batch(mj_makeData(m.get()));
    for (int world = 0; world < worlds; ++world) {
      mjb_getData(batch.get(), world, of_batch.get());
      EXPECT_EQ(FullState(m.get(), of_batch.get()), half) << world;
    }
  }
}

std::string NameOf(const testing::TestParamInfo<std::tuple<size_t, Form, const char*>>& test) {
  const auto& [law, form, integrator] = test.param;
  return fmt::format("{}_{}_{}", FrictionsOfEveryLaw()[law].law,
                     form == Form::actuator ? "actuator" : "passive", integrator);
}

INSTANTIATE_TEST_SUITE_P(EveryLawAndForm, CarriageOfStates,
                         testing::Combine(testing::Range(size_t{0}, FrictionsOfEveryLaw().size()),
                                          testing::Values(Form::actuator, Form::passive),
                                          testing::Values("Euler", "implicitfast", "RK4")),
                         NameOf);

}  // namespace
}  // namespace warmjoint

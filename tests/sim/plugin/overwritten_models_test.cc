// A model that another one overwrites in place, as mjb_getModel writes them, in the midst of a run.
#include <gmock/gmock.h>

#include "tests/sim/plugin/two_forms.h"

namespace warmjoint {
namespace {

using namespace test;

/// An arm with friction of one level, N.m, overwritten by one of another.
class PluginOverwritten : public testing::TestWithParam<std::tuple<Form, const char*>> {
 protected:
  PluginOverwritten() {
    EXPECT_EQ(models[0]->npluginattr, models[1]->npluginattr);
    begin = FullState(models[0].get(), Data(mj_makeData(models[0].get())).get());
  }

  Model Arm(double level) const {
    Friction friction = FrictionsOfEveryLaw()[0];
    friction.parameters["coulomb"] = level;
    return MustCompile(ArmXml(friction, std::get<0>(GetParam()), std::get<1>(GetParam())));
  }

  void Overwrite(int k) const {
    std::copy_n(models[k]->plugin_attr, models[k]->npluginattr, place->plugin_attr);
  }

  /// The first joint's states.
  mjtNum* States(mjData* d) const {
    if (std::get<0>(GetParam()) == Form::actuator) return d->act;
    return d->plugin_state + place->plugin_stateadr[0] + kFrictionReports;
  }

  /// Where the second model's own data come to from that state. New data let the others look for
  /// another model, so that this comes last.
  std::vector<mjtNum> EndOfSecond(const std::vector<mjtNum>& state) const {
    const Data d(mj_makeData(models[1].get()));
    mj_setState(models[1].get(), d.get(), state.data(), mjSTATE_FULLPHYSICS);
    DriveArm(models[1].get(), d.get(), 300);
    return FullState(models[1].get(), d.get());
  }

  std::vector<mjtNum> End(mjData* d) const {
    DriveArm(place.get(), d, 300);
    return FullState(place.get(), d);
  }

  const Model models[2] = {Arm(0.2), Arm(0.9)}, place = Arm(0.2);
  std::vector<mjtNum> begin;
};

TEST_P(PluginOverwritten, IsTheOtherOneFromTheNextStateThatIsSet) {
  const Data d(mj_makeData(place.get()));
  DriveArm(place.get(), d.get(), 100);
  Overwrite(1);
  mj_setState(place.get(), d.get(), begin.data(), mjSTATE_FULLPHYSICS);
  const std::vector<mjtNum> end = End(d.get());
  EXPECT_EQ(end, EndOfSecond(begin));
}

TEST_P(PluginOverwritten, IsTheOldOneAsLongAsTheRunGoesOn) {
  if (place->opt.integrator == mjINT_RK4) GTEST_SKIP() << "its stages are at other times";
  const Data d(mj_makeData(place.get())), own(mj_makeData(models[0].get()));
  DriveArm(place.get(), d.get(), 100);
  DriveArm(models[0].get(), own.get(), 100);
  // holds only where the engine rounds act as the plugin expects, so that nothing looks at every step
  Overwrite(1);
  DriveArm(place.get(), d.get(), 100);
  DriveArm(models[0].get(), own.get(), 100);
  EXPECT_EQ(FullState(place.get(), d.get()), FullState(models[0].get(), own.get()));
}

TEST_P(PluginOverwritten, IsTheOtherOneFromTheNextReset) {
  const Data d(mj_makeData(place.get()));
  DriveArm(place.get(), d.get(), 100);
  Overwrite(1);
  mj_resetData(place.get(), d.get());
  const std::vector<mjtNum> end = End(d.get());
  EXPECT_EQ(end, EndOfSecond(begin));
}

TEST_P(PluginOverwritten, IsTheOtherOneFromAStateOfItsOwnThatHoldsTheSameNumbers) {
  // what is held moves alike in both: only the mark tells whose state it is
  const Data d(mj_makeData(place.get())), own(mj_makeData(models[1].get()));
  mj_step(place.get(), d.get());
  mj_step(models[1].get(), own.get());
  const std::vector<mjtNum> state = FullState(models[1].get(), own.get());
  ASSERT_EQ(d->qvel[0], own->qvel[0]);
  ASSERT_EQ(States(d.get())[0], States(own.get())[0]);
  Overwrite(1);
  mj_setState(place.get(), d.get(), state.data(), mjSTATE_FULLPHYSICS);
  const std::vector<mjtNum> end = End(d.get());
  EXPECT_EQ(end, EndOfSecond(state));
}

TEST_P(PluginOverwritten, IsTheOtherOneFromAStateThatIsWrittenByHand) {
  const Data d(mj_makeData(place.get()));
  DriveArm(place.get(), d.get(), 100);
  Overwrite(1);
  States(d.get())[1] = -0.1;
  const std::vector<mjtNum> state = FullState(place.get(), d.get());
  const std::vector<mjtNum> end = End(d.get());
  EXPECT_EQ(end, EndOfSecond(state));
}

TEST_P(PluginOverwritten, IsTheOtherOneAfterTheNextDataWasMade) {
  const Data d(mj_makeData(place.get()));
  DriveArm(place.get(), d.get(), 100);
  Overwrite(1);
  const std::vector<mjtNum> state = FullState(place.get(), d.get());
  const Data announces(mj_makeData(place.get()));
  const std::vector<mjtNum> end = End(d.get());
  EXPECT_EQ(end, EndOfSecond(state));
}

TEST_P(PluginOverwritten, TakesTurnsWithTheOtherOneFromRest) {
  // both move alike until the drive exceeds the lower level, with the same numbers in their states
  const Data turns(mj_makeData(place.get()));
  const Data own[] = {Data(mj_makeData(models[0].get())), Data(mj_makeData(models[1].get()))};
  std::vector<mjtNum> states[] = {begin, begin};
  for (int i = 0; i < 300; ++i) {
    for (int k = 0; k < 2; ++k) {
      Overwrite(k);
      mj_setState(place.get(), turns.get(), states[k].data(), mjSTATE_FULLPHYSICS);
      DriveArm(place.get(), turns.get(), 1);
      states[k] = FullState(place.get(), turns.get());
      DriveArm(models[k].get(), own[k].get(), 1);
      ASSERT_EQ(states[k], FullState(models[k].get(), own[k].get())) << i << ", " << k;
    }
  }
  EXPECT_NE(own[0]->qpos[0], own[1]->qpos[0]);
}

TEST_P(PluginOverwritten, OfBeforeThereWasAMarkMovesAlike) {
  const Data marked(mj_makeData(place.get()));
  DriveArm(place.get(), marked.get(), 300);
  // such a model has one number less in plugin_state
  --place->plugin_statenum[0];
  const Data d(mj_makeData(place.get()));
  mjtNum& behind = d->plugin_state[place->npluginstate - 1];
  behind = 5;
  DriveArm(place.get(), d.get(), 300);
  EXPECT_THAT(std::vector(d->qpos, d->qpos + kArmJoints),
              testing::ElementsAreArray(marked->qpos, kArmJoints));
  EXPECT_EQ(behind, 5);
}

TEST_P(PluginOverwritten, OrTheDataOfAnotherOneInTheMidstOfARun) {
  const Data d(mj_makeData(models[0].get()));
  std::vector<mjtNum> state = begin;
  for (const int k : {0, 1, 0, 1, 1, 0}) {
    DriveArm(models[k].get(), d.get(), 60);
    const Data fresh(mj_makeData(models[k].get()));
    mj_setState(models[k].get(), fresh.get(), state.data(), mjSTATE_FULLPHYSICS);
    DriveArm(models[k].get(), fresh.get(), 60);
    state = FullState(models[k].get(), d.get());
    ASSERT_EQ(state, FullState(models[k].get(), fresh.get()));
  }
}

INSTANTIATE_TEST_SUITE_P(Forms, PluginOverwritten,
                         testing::Combine(testing::Values(Form::actuator, Form::passive),
                                          testing::Values("Euler", "implicitfast", "RK4")));

}  // namespace
}  // namespace warmjoint

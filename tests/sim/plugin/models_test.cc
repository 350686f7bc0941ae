// One mjData with several models in turn, as rollouts over lists of models have it, and one model that another
// overwrites in place, as mjb_getModel writes them, in the midst of a run.
#include <gmock/gmock.h>

#include <functional>

#include "sim/plugin/prepared_instances.h"
#include "tests/sim/plugin/two_forms.h"

namespace warmjoint {
namespace {

using namespace test;

Friction Coulomb(double level) {
  Friction friction = FrictionsOfEveryLaw()[0];
  friction.parameters["coulomb"] = level;
  return friction;
}

/// With a map whose weights, all but one, are of this many N.m.
Friction Mapped(double weight, double other) {
  Friction friction = FrictionsOfEveryLaw()[2];
  FrictionMap map{{{MapQuantity::motor_position, CircleAxis(6.283185307179586, 36)},
                   {MapQuantity::velocity, SpeedAxis(0.2, 2, 3)}},
                  KernelKind::normalised,
                  std::vector<double>(36 * 6, weight),
                  MapFactor::direction};
  map.weights[100] = other;
  friction.maps = {map};
  return friction;
}

/// Speed of the first joint after half a second in this data.
double SpeedIn(const Model& m, mjData* d) {
  mj_resetData(m.get(), d);
  d->qvel[0] = 3;
  for (int i = 0; i < 500; ++i) mj_step(m.get(), d);
  return d->qvel[0];
}

TEST(PluginModels, AMappedModelAtTheSamePlaceInMemoryIsAnotherOneWhereverItDiffers) {
  const Model m = MustCompile(ArmXml(Mapped(0.01, 0.01), Form::passive, "implicitfast"));
  const Data d(mj_makeData(m.get()));
  SpeedIn(m, d.get());
  const Model other = MustCompile(ArmXml(Mapped(0.01, 0.31), Form::passive, "implicitfast"));
  ASSERT_EQ(m->npluginattr, other->npluginattr);
  std::copy_n(other->plugin_attr, m->npluginattr, m->plugin_attr);
  const Data fresh(mj_makeData(other.get()));
  // one number amidst thousands
  EXPECT_EQ(SpeedIn(m, d.get()), SpeedIn(other, fresh.get()));
}

TEST(PluginModels, DataOfAMappedArmParsesOnce) {
  // parsing and surveying takes some milliseconds; a hundred data would take half a second of it
  const Model m = MustCompile(ArmXml(Mapped(0.01, 0.01), Form::passive, "implicitfast"));
  const auto first = PrepareInstance(m.get(), 0);
  EXPECT_EQ(PrepareInstance(m.get(), 0), first);
}

/// Attributes of some hundred bytes, which are compared as a whole at each step, and of some thousand.
enum class Text { short_one, long_one };

/// An arm with friction of one level, N.m, overwritten by one of another.
class PluginOverwritten : public testing::TestWithParam<std::tuple<Form, const char*, Text>> {
 protected:
  PluginOverwritten() {
    EXPECT_EQ(models[0]->npluginattr, models[1]->npluginattr);
    begin = FullState(models[0].get(), Data(mj_makeData(models[0].get())).get());
  }

  Model Arm(double level) const {
    Friction friction = Coulomb(level);
    if (std::get<2>(GetParam()) == Text::long_one) friction.maps = Mapped(level, 0.1).maps;
    return MustCompile(ArmXml(friction, std::get<0>(GetParam()), std::get<1>(GetParam())));
  }

  void Overwrite(int k) const {
    std::copy_n(models[k]->plugin_attr, models[k]->npluginattr, place->plugin_attr);
  }

  mjtNum* States(mjData* d) const { return StatesOf(place.get(), d); }

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

TEST_P(PluginOverwritten, IsTheOtherOneFromTheNextStateResetOrData) {
  Data announces;
  const std::function<void(mjData*)> changes[] = {
      [&](mjData* d) { mj_setState(place.get(), d, begin.data(), mjSTATE_FULLPHYSICS); },
      [&](mjData* d) { mj_resetData(place.get(), d); },
      [&](mjData* d) { States(d)[1] = -0.1; },
      [&](mjData*) { announces.reset(mj_makeData(place.get())); },
  };
  for (const auto& change : changes) {
    Overwrite(0);
    const Data d(mj_makeData(place.get()));
    DriveArm(place.get(), d.get(), 100);
    Overwrite(1);
    change(d.get());
    const std::vector<mjtNum> state = FullState(place.get(), d.get());
    const std::vector<mjtNum> end = End(d.get());
    EXPECT_EQ(end, EndOfSecond(state));
  }
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

TEST_P(PluginOverwritten, OrTheDataOfAnotherOneFromAResetAndInTheMidstOfARun) {
  const Data d(mj_makeData(models[1].get()));
  DriveArm(models[1].get(), d.get(), 60);
  mj_resetData(models[0].get(), d.get());
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
                                          testing::Values("Euler", "implicitfast", "RK4"),
                                          testing::Values(Text::short_one, Text::long_one)));

}  // namespace
}  // namespace warmjoint

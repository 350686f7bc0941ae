// One mjData with several models in turn, as rollouts over lists of models have it.
#include <gmock/gmock.h>

#include "sim/plugin/attributes.h"
#include "tests/sim/plugin/two_forms.h"

namespace warmjoint {
namespace {

using namespace test;

FrictionDescription Coulomb(double level) {
  FrictionDescription friction = FrictionsOfEveryLaw()[0];
  friction.parameters["coulomb"] = level;
  return friction;
}

/// Speed of the first joint after half a second in this data.
double SpeedIn(const Model& m, mjData* d) {
  mj_resetData(m.get(), d);
  d->qvel[0] = 3;
  for (int i = 0; i < 500; ++i) mj_step(m.get(), d);
  return d->qvel[0];
}

TEST(PluginModels, EachHasItsOwnFrictionInTheDataOfAnother) {
  for (const Form form : {Form::actuator, Form::passive}) {
    std::vector<Model> models;
    for (const double level : {0.2, 0.5, 0.8, 1.1}) {
      models.push_back(MustCompile(ArmXml(Coulomb(level), form, "implicitfast")));
    }
    const Data shared(mj_makeData(models[0].get()));
    double before = 0;
    for (const Model& m : models) {
      const Data own(mj_makeData(m.get()));
      const double expected = SpeedIn(m, own.get());
      EXPECT_EQ(SpeedIn(m, shared.get()), expected);
      EXPECT_NE(expected, before);
      before = expected;
    }

    // step by step in turn, with the states of each
    const Data one(mj_makeData(models[1].get())), two(mj_makeData(models[2].get()));
    const Data turns(mj_makeData(models[0].get()));
    std::vector<mjtNum> states[] = {FullState(models[1].get(), one.get()),
                                    FullState(models[2].get(), two.get())};
    for (int i = 0; i < 200; ++i) {
      for (int k = 0; k < 2; ++k) {
        const mjModel* m = models[static_cast<size_t>(1 + k)].get();
        mj_setState(m, turns.get(), states[k].data(), mjSTATE_FULLPHYSICS);
        DriveArm(m, turns.get(), 1);
        states[k] = FullState(m, turns.get());
      }
      DriveArm(models[1].get(), one.get(), 1);
      DriveArm(models[2].get(), two.get(), 1);
    }
    EXPECT_EQ(states[0], FullState(models[1].get(), one.get()));
    EXPECT_EQ(states[1], FullState(models[2].get(), two.get()));
  }
}

TEST(PluginModels, AModelAtTheSamePlaceInMemoryIsAnotherOne) {
  const std::string xml = ArmXml(Coulomb(0.2), Form::passive, "implicitfast");
  const Model m = MustCompile(xml);
  const Data d(mj_makeData(m.get()));
  SpeedIn(m, d.get());

  // what a compiler that reuses memory leaves: the same addresses, another text
  const Model other = MustCompile(ArmXml(Coulomb(0.9), Form::passive, "implicitfast"));
  ASSERT_EQ(m->npluginattr, other->npluginattr);
  std::copy_n(other->plugin_attr, m->npluginattr, m->plugin_attr);
  const Data fresh(mj_makeData(other.get()));
  EXPECT_EQ(SpeedIn(m, d.get()), SpeedIn(other, fresh.get()));
}

TEST(PluginModels, AModelThatIsOverwrittenInPlaceIsTheOneWhoseStatesGoOn) {
  for (const Form form : {Form::actuator, Form::passive}) {
    const Model models[] = {MustCompile(ArmXml(Coulomb(0.2), form, "implicitfast")),
                            MustCompile(ArmXml(Coulomb(0.9), form, "implicitfast"))};
    ASSERT_EQ(models[0]->npluginattr, models[1]->npluginattr);
    const Model place = MustCompile(ArmXml(Coulomb(0.2), form, "implicitfast"));
    const Data turns(mj_makeData(place.get()));
    const Data own[] = {Data(mj_makeData(models[0].get())), Data(mj_makeData(models[1].get()))};
    std::vector<mjtNum> states[2];
    for (int k = 0; k < 2; ++k) {
      own[k]->qvel[0] = 3;
      states[k] = FullState(models[k].get(), own[k].get());
    }

    // as mjb_getModel writes one simulation's model after the other, which nothing announces
    for (int i = 0; i < 200; ++i) {
      for (int k = 0; k < 2; ++k) {
        const mjModel* m = models[k].get();
        std::copy_n(m->plugin_attr, m->npluginattr, place->plugin_attr);
        mj_setState(m, turns.get(), states[k].data(), mjSTATE_FULLPHYSICS);
        DriveArm(place.get(), turns.get(), 1);
        states[k] = FullState(m, turns.get());
        DriveArm(m, own[k].get(), 1);
        ASSERT_EQ(states[k], FullState(m, own[k].get())) << i;
      }
    }
    EXPECT_NE(states[0], states[1]);
  }
}

/// With a map whose weights, all but one, are of this many N.m.
FrictionDescription Mapped(double weight, double other) {
  FrictionDescription friction = FrictionsOfEveryLaw()[2];
  FrictionMap map{{{MapQuantity::motor_position, CircleAxis(6.283185307179586, 36)},
                   {MapQuantity::velocity, SpeedAxis(0.2, 2, 3)}},
                  KernelKind::normalised,
                  std::vector<double>(36 * 6, weight),
                  MapFactor::direction};
  map.weights[100] = other;
  friction.maps = {map};
  return friction;
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
  const auto first = PrepareInstance(m.get(), 0, {"test"});
  EXPECT_EQ(PrepareInstance(m.get(), 0, {"test"}), first);
}

}  // namespace
}  // namespace warmjoint

#include "sim/model/load_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/model/attach.h"
#include "tests/models/recording/temporary_file.h"
#include "tests/sim/model/light_friction.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

using test::LightFriction;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A hinge that another plugin's actuator drives.
std::string DrivenBy(const std::string& plugin) {
  return R"(<mujoco><extension><plugin plugin=")" + plugin +
         R"("><instance name="p"><config key="kp" value="40"/></instance></plugin></extension>
    <worldbody><body><joint name="j" axis="0 1 0"/><geom size="0.1"/></body></worldbody>
    <actuator><plugin joint="j" plugin=")" +
         plugin + R"(" instance="p"/></actuator></mujoco>)";
}

TEST(OtherPlugins, ThatComeWithMujocoAreLoadedWhereAModelAsksForThem) {
  const TemporaryFile model("pid.xml", DrivenBy("mujoco.pid"));
  const ScratchDirectory folder;
  const auto out = folder.path() / "out.xml";
  AttachFriction(model.path(), {{"j", LightFriction()}}, out);
  const LoadedModel loaded = LoadModel(out);
  EXPECT_EQ(loaded.model->nplugin, 2);
  EXPECT_EQ(loaded.model->nactuator, 2);

  // the controller works beside the friction: 40 N.m/rad on a step of 1 rad
  const DataPtr data(mj_makeData(loaded.model.get()));
  data->ctrl[0] = 1;
  mj_forward(loaded.model.get(), data.get());
  EXPECT_DOUBLE_EQ(data->actuator_force[0], 40);
}

TEST(OtherPlugins, ThatNobodyHasAreRefusedByName) {
  const TemporaryFile model("own.xml", DrivenBy("acme.drive"));
  EXPECT_THAT([&] { LoadModel(model.path()); },
              ThrowsMessage<BadInput>(AllOf(HasSubstr("'acme.drive'"), HasSubstr("take its"))));
}

TEST(UnknownPlugin, NamesThePluginOfAComplaint) {
  EXPECT_EQ(UnknownPlugin("Error: plugin mujoco.pid not found"), "mujoco.pid");
  EXPECT_EQ(UnknownPlugin("XML Error: unknown plugin 'acme.drive'; line 3"), "acme.drive");
  EXPECT_EQ(UnknownPlugin("unknown element 'bodi'"), "");
}

}  // namespace
}  // namespace warmjoint

#include "sim/model/urdf_meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/attach.h>

#include <fstream>

#include "models/foundation/atomic_file.h"
#include "sim/model/load_model.h"
#include "tests/sim/model/light_friction.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;
using test::LightFriction;
using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

constexpr char kTetrahedron[] =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

/// A URDF of one moving link in a folder of its own, with a package beside it.
class UrdfMeshes : public testing::Test {
 protected:
  UrdfMeshes() {
    fs::create_directories(package_ / "meshes");
    WriteWholeFile(package_ / "meshes" / "link.obj", kTetrahedron);
    fs::create_directory(urdf_.parent_path());
    WriteWholeFile(urdf_.parent_path() / "near.obj", kTetrahedron);
  }

  /// Writes the URDF with these <visual> and <collision> elements.
  void Write(const std::string& shapes, const std::string& extension = "") {
    WriteWholeFile(urdf_, R"(<robot name="arm"><link name="base"/>
      <joint name="hinge" type="revolute"><parent link="base"/><child link="arm"/>
      <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="5" velocity="2"/></joint>
      <link name="arm"><inertial><mass value="2"/>
      <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>)" +
                              shapes + "</link>" + extension + "</robot>");
  }

  static std::string Shape(const std::string& kind, const std::string& file) {
    return "<" + kind + "><geometry><mesh filename=\"" + file + "\"/></geometry></" + kind + ">";
  }

  const ScratchDirectory folder_;
  const fs::path package_ = folder_.path() / "ros" / "arm_description";
  const fs::path urdf_ = folder_.path() / "robot" / "arm.urdf";
};

TEST_F(UrdfMeshes, KeepWhatIsOnlyToBeSeen) {
  Write(Shape("visual", "near.obj") + "<visual><geometry><box size='1 1 1'/></geometry></visual>");
  const LoadedModel loaded = LoadModel(urdf_);
  EXPECT_THAT(loaded.notices, IsEmpty());
  EXPECT_EQ(loaded.model->ngeom, 2);
  EXPECT_EQ(loaded.model->nmesh, 1);
  // seen, not touched, and without mass
  EXPECT_EQ(loaded.model->geom_contype[0], 0);
  EXPECT_EQ(loaded.model->body_mass[1], 2);
}

TEST_F(UrdfMeshes, ObeyAUrdfThatDiscardsItsVisuals) {
  Write(Shape("visual", "near.obj"), "<mujoco><compiler discardvisual=\"true\"/></mujoco>");
  EXPECT_EQ(LoadModel(urdf_).model->ngeom, 0);
}

TEST_F(UrdfMeshes, KeepVisualsBesideOtherSettingsOfTheUrdf) {
  for (const char* compiler : {"", "<compiler balanceinertia=\"true\"/>"}) {
    Write(Shape("visual", "near.obj"),
          "<mujoco><option timestep=\"0.003\"/>" + std::string(compiler) + "</mujoco>");
    const LoadedModel loaded = LoadModel(urdf_);
    EXPECT_EQ(loaded.model->ngeom, 1);
    EXPECT_EQ(loaded.model->opt.timestep, 0.003);
  }
}

TEST_F(UrdfMeshes, AreFoundInAPackageAlsoByTheWrittenModel) {
  Write(Shape("visual", "package://arm_description/meshes/link.obj") +
        Shape("collision", "package://arm_description/meshes/link.obj"));
  const fs::path out = folder_.path() / "out.xml";
  AttachOptions options;
  options.packages = {{"arm_description", package_}};
  const Attached attached = AttachFriction(urdf_, {{"hinge", LightFriction()}}, out, options);
  EXPECT_THAT(attached.notices, Each(Not(HasSubstr("left out"))));
  const LoadedModel loaded = LoadModel(out);
  EXPECT_EQ(loaded.model->ngeom, 2);

  // both move together: nothing in the model names this machine
  EXPECT_THAT(ReadWholeFile(out), Not(HasSubstr(folder_.path())));
}

TEST_F(UrdfMeshes, AreLeftOutWithOneSentenceForEachReason) {
  WriteWholeFile(urdf_.parent_path() / "link.dae", "collada");
  Write(Shape("visual", "package://elsewhere/a.stl") + Shape("visual", "link.dae") +
        Shape("visual", "absent.stl") + Shape("visual", "near.obj"));
  const LoadedModel loaded = LoadModel(urdf_);
  EXPECT_THAT(loaded.notices,
              ElementsAre(AllOf(HasSubstr("a.stl"), HasSubstr("--package elsewhere=FOLDER")),
                          AllOf(HasSubstr("link.dae"), HasSubstr("does not read")),
                          AllOf(HasSubstr("absent.stl"), HasSubstr("no file"))));
  EXPECT_EQ(loaded.model->ngeom, 1);
}

TEST_F(UrdfMeshes, RefuseAPackageThatLacksTheFile) {
  Write(Shape("visual", "package://arm_description/meshes/other.obj"));
  EXPECT_THAT(
      [&] {
        ParseModel(urdf_, {{"arm_description", package_}});
      },
      ThrowsMessage<BadInput>(AllOf(HasSubstr("other.obj"), HasSubstr("--package"))));
}

}  // namespace
}  // namespace warmjoint

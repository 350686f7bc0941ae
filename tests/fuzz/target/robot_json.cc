// robot.json through what reads it: attach, export to every engine and controller, and the facts of a report.
#include <nlohmann/json.hpp>

#include "identification/robot/robot_estimate.h"
#include "models/foundation/excerpt.h"
#include "sim/model/attach_text.h"
#include "tests/fuzz/fuzz.h"
#include "tools/export/engine_text.h"
#include "tools/robot/robot_friction.h"
#include "tools/shown/estimate_data.h"

namespace {

using namespace warmjoint;

constexpr const char* kArm = R"(<mujoco><compiler angle="radian"/><worldbody><body>
  <joint name="a" axis="0 1 0" armature=".1"/><geom type="capsule" fromto="0 0 0 0 0 .4" size=".04" mass="4"/>
  <body pos="0 0 .4"><joint name="b" axis="0 1 0" armature=".1"/><geom size=".1" mass="2"/></body></body></worldbody></mujoco>)";

/// Ends the process where a program or a terminal could act on what was made of names.
void RequireText(std::string_view text) { fuzz::Require(PrintableLines(text) == text); }

/// What one reader refuses, the next may take.
template <typename Work>
void Try(const Work& work) {
  try {
    work();
  } catch (const BadInput& refusal) {
    fuzz::Require(*refusal.what() != '\0');
  }
}

}  // namespace

void warmjoint::fuzz::Read(std::string_view bytes) {
  const fuzz::ScratchFile file(bytes, ".json");
  Try([&] {
    const RobotEstimate robot = ReadRobotEstimate(file.path());
    RobotEstimateToTree(robot).dump();
    shown::ShownData data;
    shown::RobotFacts(robot, data).dump();
  });
  for (const Word<EngineFormat>& format : WordsOf(EngineFormat{})) {
    Try([&] {
      ExportRequest request;
      request.to = format.value;
      const Exported exported = ExportFrictions(ReadJsonNode(file.path()), request);
      RequireText(ExportText(exported));
    });
  }
  Try([&] {
    std::vector<std::string> warnings;
    const std::vector<FrictionForJoint> frictions =
        FrictionsOfRobot(file.path(), {}, "cold", warnings);
    const fuzz::ScratchFile arm(kArm, ".xml");
    const AttachedText made = AttachFrictionAsText(arm.path(), frictions, "warm.xml");
    RequireText(made.xml);
  });
}

// Friction in the words of an engine, ready to be pasted.
#pragma once

#include <string>
#include <vector>

#include "models/foundation/node.h"
#include "tools/export/engine_friction.h"

namespace warmjoint {

/// What is asked for.
struct ExportRequest {
  EngineFormat to = EngineFormat::mjcf;
  Warmth warmth{};
  bool native = false;      // of mjcf: springs with a yield in place of frictionloss
  double timestep = 0.001;  // s, of the model that springs are for
  std::string
      joint{};  // what the joint of an estimate is called; needed where a text finds joints by name (NeedsName)

  template <class A>
  void Serialize(A* a) {
    a->Field("to", &to, {.needed = "name an engine"});
    a->Field("warm", &warmth.share);
    a->Field("speed", &warmth.speed, {.unit = "rad/s"});
    a->Field("native", &native);
    a->Field("timestep", &timestep, {.unit = "s", .bounds = kPositive});
    a->Field("joint", &joint);
  }
};

struct Exported {
  ExportRequest request;
  std::vector<EngineFriction> frictions;
  std::vector<std::string> notices;  // which joints were left out, one sentence each
  std::vector<SeenFriction> whole;   // as they were seen
};

/// Whether what is written means a joint by its name; of the others it is pasted into the joint that it is for.
inline bool NeedsName(EngineFormat format) {
  return format == EngineFormat::physx || format == EngineFormat::isaaclab ||
         format == EngineFormat::mjlab || format == EngineFormat::ros2;
}

/// The frictions of a file: of estimate.json or a friction file one, of robot.json all that are known in N.m or N, by their own
/// names. Throws BadInput, also for a joint without a name where the engine needs one, and for a warmth where heat is a state.
Exported ExportFrictions(const Node& file, const ExportRequest& request);

/// The comments on one joint: its warmth, and what its numbers leave out.
std::string EngineHead(const EngineFriction& one, EngineFormat format);

/// EngineText, NativeText where springs were asked for; of controllers CodeText, RosText or UrText; of an FMU its model description.
std::string ExportText(const Exported& exported);

/// What the engine reads, with what it leaves out as comments. Where the friction has an interval, numbers end at the second digit of its half
/// width; else they have twelve digits.
std::string EngineText(const std::vector<EngineFriction>& frictions, EngineFormat format);

/// {to, joints{NAME: {kind, warm, speed, energy, slowest, fastest, viscous, level, static_level, left_out[]}}, notices[], text}; where heat is a
/// state no joints; of an FMU {model, files{PATH: text}} besides
Tree EngineJson(const Exported& exported);

}  // namespace warmjoint

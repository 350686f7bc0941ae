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
  Warmth warmth;
  std::string joint = "JOINT";  // what the joint of an estimate is called

  template <class A>
  void Serialize(A* a) {
    a->Field("to", &to, {.needed = "name an engine"});
    a->Field("warm", &warmth.share);
    a->Field("speed", &warmth.speed, {.unit = "rad/s"});
    a->Field("joint", &joint);
  }
};

struct Exported {
  std::vector<EngineFriction> frictions;
  std::vector<std::string> notices;  // which joints were left out, one sentence each
};

/// The frictions of a file: of estimate.json or a friction file one, of robot.json all that are known in N.m or N, by their own
/// names. Throws BadInput.
Exported ExportFrictions(const Node& file, const ExportRequest& request);

/// What the engine reads, with what it leaves out as comments.
std::string EngineText(const std::vector<EngineFriction>& frictions, EngineFormat format);

/// {to, joints{NAME: {kind, warm, speed, energy, slowest, fastest, viscous, level, static_level, left_out[]}}, notices[], text}
Tree EngineJson(const Exported& exported, EngineFormat format);

}  // namespace warmjoint

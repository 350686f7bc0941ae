// The plugin's name.
#pragma once

namespace warmjoint::inline sim {

/// Name under which MuJoCo knows the plugin.
inline constexpr char kFrictionPlugin[] = "warmjoint.friction";

}  // namespace warmjoint::inline sim

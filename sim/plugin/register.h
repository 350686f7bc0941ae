// Making the plugin `warmjoint.friction` known to MuJoCo.
#pragma once

namespace warmjoint {

/// Name under which MuJoCo knows the plugin.
inline constexpr char kFrictionPlugin[] = "warmjoint.friction";

/// Registers the plugin; repeating it does nothing. Programs that link the plugin call it before
/// they load a model; the shared library calls it when it is loaded.
void RegisterFrictionPlugin();

}  // namespace warmjoint

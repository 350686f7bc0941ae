// Data that an instance refuses while the engine makes it.
#pragma once

#include <mujoco/mujoco.h>

namespace warmjoint::inline sim {

/// Whether this version of the engine, as mj_version() tells it, frees data after a plugin's -1 as
/// RefuseData does in its place. Read from 4.0's source; a later one must be read before it is named.
constexpr bool KnowsEngine(int version) { return version / 1000 == 4000; }

/// Refuses data from within a plugin's init, which returns what this returns. Where the engine is known, the
/// data is freed as the engine frees it after a -1, with what the instances before have made for it,
/// which the engine leaves, and the refusal is told once, as an error; that leaves by longjmp, so that
/// no caller may have anything left to do. Elsewhere it is a warning, and -1 as MuJoCo documents it:
/// the engine then tells an error of its own, to which its compiler appends the warning.
int RefuseData(const mjModel* m, mjData* d, int instance, const char* refusal,
               int version = mj_version());

}  // namespace warmjoint::inline sim

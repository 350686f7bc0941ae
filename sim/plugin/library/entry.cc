// Entry of the shared library: MuJoCo calls it when the library is loaded.
#include <mujoco/mujoco.h>

#include "sim/plugin/register.h"

mjPLUGIN_LIB_INIT(warmjoint_friction) { warmjoint::RegisterFrictionPlugin(); }

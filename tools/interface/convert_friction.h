// Friction of the interface and of the rooms.
#pragma once

#include <warmjoint/friction.h>

#include "models/friction/friction_description.h"

namespace warmjoint::api {

/// Checked (models::CheckFriction). Throws models::BadInput.
models::FrictionDescription ToDescription(const Friction& friction);

Friction FromDescription(const models::FrictionDescription& friction);

}  // namespace warmjoint::api

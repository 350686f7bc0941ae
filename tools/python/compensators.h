// Friction compensation as Python has it.
#pragma once

#include <nanobind/nanobind.h>

namespace warmjoint::python {

/// The class Compensator of a module.
void AddCompensators(nanobind::module_& module);

}  // namespace warmjoint::python

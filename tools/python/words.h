// Messages of the program in the words of Python: options of the command line as arguments of functions.
#pragma once

#include <nanobind/nanobind.h>

#include <string>
#include <string_view>
#include <vector>

#include "models/foundation/node.h"

namespace warmjoint::python {

/// The text with each option as the argument that Python's functions have for it: `--map position=q` as map={"position": "q"},
/// `--identifier stribeck --set law=coulomb` as method="stribeck", law="coulomb", `--trim` without a value as trim. Options that no
/// function has stay.
std::string InPython(std::string_view text);

/// The calls that a text recommends: of each run of options with values a map from argument to value, in their order.
std::vector<Tree> CallsIn(std::string_view text);

/// What an exception of Python says, with nothing in it that a terminal acts on.
std::string PrintableText(nanobind::handle raised);

/// Lets a module's functions raise BadInput and OutputFailed of `core` with such messages.
void SpeakPython(nanobind::module_ core);

}  // namespace warmjoint::python

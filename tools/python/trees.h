// Values of the program as Python has them: dicts, lists, numbers and texts, by the Serialize that files are read and written by.
#pragma once

#include <nanobind/nanobind.h>

#include <Eigen/Core>
#include <string>

#include "models/foundation/node.h"
#include "models/foundation/serialize.h"

namespace warmjoint::python {

/// Numbers keep all their bits; null is None.
nanobind::object ToPython(const Tree& tree);

/// The inverse, also of numbers and arrays of NumPy and of paths. Throws BadInput with `name` for what is none of these, holds itself, is
/// nested more than 64 levels deep, or holds whole numbers beyond 64 bits or texts that are no UTF-8.
Tree ToTree(nanobind::handle value, const std::string& name);

/// A text of Python as UTF-8. Throws BadInput with `name` for one with surrogates.
std::string TextOf(nanobind::handle text, const std::string& name);

/// A column as an array of NumPy that owns its memory, [N].
nanobind::object ToPython(Eigen::VectorXd column);

template <Described T>
nanobind::object FieldsToPython(const T& value) {
  return ToPython(WriteFields(value));
}

/// name: what messages call the value. Throws BadInput as ReadFields does.
template <Described T>
T FieldsFromPython(nanobind::handle value, const std::string& name) {
  return ReadAs<T>(Node(ToTree(value, name), name));
}

}  // namespace warmjoint::python

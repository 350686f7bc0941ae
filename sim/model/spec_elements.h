// Walking over the elements of an mjSpec.
#pragma once

#include <mujoco/mujoco.h>

#include <string>
#include <vector>

namespace warmjoint::inline sim {

// MuJoCo's own library is built with another C++ library than this program may be: strings and
// vectors of an mjSpec are touched through mjs_get... and mjs_set... alone.

/// All elements of a kind, in the order of the model.
inline std::vector<mjsElement*> SpecElements(mjSpec& spec, mjtObj type) {
  std::vector<mjsElement*> elements;
  for (mjsElement* e = mjs_firstElement(&spec, type); e; e = mjs_nextElement(&spec, e)) {
    elements.push_back(e);
  }
  return elements;
}

/// The names of all elements of a kind, without the nameless.
inline std::vector<std::string> SpecNames(mjSpec& spec, mjtObj type) {
  std::vector<std::string> names;
  for (mjsElement* element : SpecElements(spec, type)) {
    std::string name = mjs_getString(mjs_getName(element));
    if (!name.empty()) names.push_back(std::move(name));
  }
  return names;
}

}  // namespace warmjoint::inline sim

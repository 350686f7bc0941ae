// MuJoCo's objects: their owners, the elements of an mjSpec, joints by name or pattern.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint {

struct DeleteMujoco {
  void operator()(mjSpec* spec) const { mj_deleteSpec(spec); }
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};

using SpecPtr = std::unique_ptr<mjSpec, DeleteMujoco>;
using ModelPtr = std::unique_ptr<mjModel, DeleteMujoco>;
using DataPtr = std::unique_ptr<mjData, DeleteMujoco>;

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

/// The name of an element; empty where it has none.
inline std::string NameOf(mjsElement* element) { return mjs_getString(mjs_getName(element)); }

/// The names of all elements of a kind, without the nameless.
inline std::vector<std::string> SpecNames(mjSpec& spec, mjtObj type) {
  std::vector<std::string> names;
  for (mjsElement* element : SpecElements(spec, type)) {
    std::string name = NameOf(element);
    if (!name.empty()) names.push_back(std::move(name));
  }
  return names;
}

/// The joint of that name. Throws BadInput, from `place`, with the nearest name, where the model
/// lacks it.
mjsJoint* FindJoint(mjSpec& spec, const std::string& joint, const Place& place);

/// The joints that a name or a pattern means: the joint of that name alone where there is one, else
/// every hinge and slide joint whose whole name the pattern, a regular expression as in ECMAScript,
/// matches, in the order of the model. Throws BadInput, from `place`, where it means none.
std::vector<std::string> MatchJoints(mjSpec& spec, const std::string& pattern, const Place& place);

/// Number of hinges and slides without a name, which no pattern can mean.
int NamelessJoints(mjSpec& spec);

}  // namespace warmjoint

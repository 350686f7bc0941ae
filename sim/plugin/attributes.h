// Configuration attributes of the plugin `warmjoint.friction`.
#pragma once

#include <warmjoint/friction.h>

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "models/foundation/bad_input.h"
#include "models/foundation/serialize.h"

namespace warmjoint {

/// A number among the attributes: a parameter of laws, of the heat's stages, or a friction's option.
struct NumberAttribute {
  std::string name;
  FieldInfo info;
};

/// All of them, each once; unit, bounds and meaning as models/friction states them.
const std::vector<NumberAttribute>& NumberAttributes();

/// Names of all laws, for the meaning of `law`.
std::string_view MeaningOfLaw();

/// A document in JSON, null where it is not given.
void ReadValue(const Node& node, Tree* value, const FieldInfo& info);
void ReadValue(const Node& node, std::filesystem::path* value, const FieldInfo& info);

/// What <config key= value=> may give, each by its name. Empty: not given.
struct PluginAttributes {
  std::string law, instance;
  std::filesystem::path file, folder;
  std::optional<double> gear;
  std::map<std::string, std::optional<double>> numbers;  // by their names
  Tree joints, maps, initial_energy;
  bool joint_sensors = false;
  bool viscous_as_damping = false;
  double stiffest_drive = 0;

  template <class A>
  void Serialize(A* a) {
    // what friction it is, and whose
    a->Field("law", &law, {.meaning = MeaningOfLaw()});
    a->Field("file", &file, {.meaning = "friction file instead of all the other attributes"});
    a->Field("joints", &joints,
             {.meaning = "friction of each joint by its name, instead of all the others"});
    a->Field("instance", &instance,
             {.meaning = "the instance's own name, so that a prefix of the model is known"});
    a->Field("folder", &folder, {.meaning = "folder from which file starts where it is relative"});

    // its numbers, and what is more than a number
    a->Field("gear", &gear,
             {.unit = "rad/rad",
              .meaning = "motor turns for each joint turn, not 0; 1 where not given"});
    for (const NumberAttribute& number : NumberAttributes()) {
      a->Field(number.name, &numbers[number.name], number.info);
    }
    a->Field("maps", &maps, {.meaning = "list of maps as in a friction file"});
    a->Field("initial_energy", &initial_energy,
             {.unit = "N.m",
              .meaning = "energy state at a reset: of every joint, or of each by its name"});
    a->Field(
        "joint_sensors", &joint_sensors,
        {.meaning = "whether each sensor of the instance reads the joint that it names alone"});
    a->Field("viscous_as_damping", &viscous_as_damping,
             {.meaning = "whether the joint's own damping is its viscous, which MuJoCo then adds"});
    a->Field("stiffest_drive", &stiffest_drive,
             {.unit = "1",
              .bounds = {.at_least = 0},
              .meaning = "h^2 kp + 2 h kv over the inertia of a servo in a program's own code"});
  }
};

/// Their names.
const std::vector<std::string>& AttributeNames();

/// The attributes that are given, by their names.
using AttributeTexts = std::map<std::string, std::string>;

/// One joint's part of what attributes describe.
struct DescribedJoint {
  Friction friction;
  std::array<double, 2> initial_energy{};  // {E1, E2} at a reset, N.m or N
};

/// By the name of the joint; under "" every joint.
using DescribedJoints = std::map<std::string, DescribedJoint>;

/// What is the same for all joints of an instance.
struct InstanceOptions {
  bool joint_sensors = false;       // whether each sensor reads one joint
  bool viscous_as_damping = false;  // whether the joints' damping is their viscous
  double stiffest_drive = 0;        // of a program's own code, in units of M/h^2
};

/// Those that the attributes give, checked as DescribeJoints does.
InstanceOptions OptionsIn(const AttributeTexts& texts, const Place& place);

/// What the attributes describe, checked. Throws BadInput, from `place`, naming attribute, value and
/// bound for: no number ("5x"), a value out of bounds, a parameter that the law lacks or needs, `file`
/// or `joints` with attributes that they would contradict, a joint twice in `joints`, or an initial
/// energy that is none of its joint.
DescribedJoints DescribeJoints(const AttributeTexts& texts, const Place& place);

/// Path, size and time of the friction file that the attributes name, which change where the file
/// does; empty where they name none.
std::string FileStamp(const AttributeTexts& texts);

/// Folder of the model that this thread loaded last, where its friction files may lie; empty where it
/// loaded none that way. MuJoCo does not tell a plugin where its model comes from.
inline std::filesystem::path& ModelFolder() {
  thread_local std::filesystem::path folder;
  return folder;
}

}  // namespace warmjoint

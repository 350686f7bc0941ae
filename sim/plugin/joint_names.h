// Names of joints in JSON, which MuJoCo does not rename when it attaches a model with a prefix.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace warmjoint::inline sim {

/// What MuJoCo put around every name of an attached model.
struct Renaming {
  std::string prefix;
  std::string suffix;

  std::string operator()(const std::string& name) const { return prefix + name + suffix; }
};

/// The names of a plugin instance: as its attribute `instance` has it, empty where not given, and
/// as the model has it.
struct InstanceNames {
  std::string written;
  std::string actual;
};

/// The renaming under which every one of `joints` exists. What stands around the written name in
/// the actual one goes first, then none, then each beginning of the actual name, the longest first,
/// then what stands before a joint's name in one of `driven`. None where nothing fits.
Renaming FindRenaming(const InstanceNames& instance, const std::vector<std::string>& joints,
                      const std::vector<std::string>& driven,
                      const std::function<bool(const std::string&)>& exists);

}  // namespace warmjoint::inline sim

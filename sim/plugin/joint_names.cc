#include "sim/plugin/joint_names.h"

#include <algorithm>

namespace warmjoint::inline sim {
namespace {

/// Every place of the written name within the actual one.
void AddAround(const InstanceNames& instance, std::vector<Renaming>& candidates) {
  const auto& [written, actual] = instance;
  if (written.empty()) return;
  for (size_t at = actual.find(written); at != std::string::npos;
       at = actual.find(written, at + 1)) {
    candidates.push_back({actual.substr(0, at), actual.substr(at + written.size())});
  }
}

}  // namespace

Renaming FindRenaming(const InstanceNames& instance, const std::vector<std::string>& joints,
                      const std::vector<std::string>& driven,
                      const std::function<bool(const std::string&)>& exists) {
  // around the written name, none, beginnings of the actual name, and those of driven joints
  std::vector<Renaming> candidates;
  AddAround(instance, candidates);
  candidates.emplace_back();
  for (size_t n = instance.actual.size(); n > 0; --n) {
    candidates.push_back({instance.actual.substr(0, n), ""});
  }
  for (const std::string& joint : driven) {
    if (joints.empty() || !joint.ends_with(joints.front())) continue;
    candidates.push_back({joint.substr(0, joint.size() - joints.front().size()), ""});
  }

  // the first of them by which every joint is there
  for (const Renaming& renaming : candidates) {
    const auto fits = [&](const std::string& joint) { return exists(renaming(joint)); };
    if (std::all_of(joints.begin(), joints.end(), fits)) return renaming;
  }
  return {};
}

}  // namespace warmjoint::inline sim

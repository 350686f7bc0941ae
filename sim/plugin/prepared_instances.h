// Instances as their attributes describe them, read once for all data of all models.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "models/friction/joint_friction.h"
#include "sim/plugin/attributes.h"

namespace warmjoint {

/// One joint's friction as it was described, and ready for a timestep.
struct PreparedJoint {
  Friction description;
  JointFriction friction;
  std::array<double, 2> initial_energy{};  // {E1, E2} at a reset, N.m or N
};

/// An instance as its attributes describe it.
struct PreparedInstance {
  std::string written_name;  // attribute `instance`; empty where not given
  InstanceOptions options;
  std::map<std::string, PreparedJoint> joints;  // by the name in `joints`; "": every joint
};

/// The instance's attributes, read and checked, and its maps surveyed. Instances with the same
/// attributes share one, so that copies of data and lists of models parse once; a friction file
/// that changed is read again. Any thread may call it. Throws BadInput that names the instance.
std::shared_ptr<const PreparedInstance> PrepareInstance(const mjModel* m, int instance);

/// The values of all the instance's attributes, as the model holds them: one after the other, each
/// ended by a 0.
inline std::string_view AttributeText(const mjModel* m, int instance) {
  const bool last = instance + 1 == m->nplugin;
  const auto begin = static_cast<size_t>(m->plugin_attradr[instance]);
  const auto end = static_cast<size_t>(last ? m->npluginattr : m->plugin_attradr[instance + 1]);
  return {m->plugin_attr + begin, end - begin};
}

/// Remembers a text. A model that was freed may have left its place in memory to another one, whose
/// text then stands there; nothing but the text itself shows that.
class AttributeWatch {
 public:
  explicit AttributeWatch(std::string_view text);

  /// Whether this is the text. All of it is compared where it is short, or where an instance has
  /// been prepared since (PrepareInstance), as each compilation and each new mjData do; of longer
  /// texts that no compilation or mjData announced, blocks that are spread over it.
  bool Same(std::string_view text);

  /// Whether no compilation and no mjData was announced since all of it was compared.
  bool Quiet() const { return prepared_ == count_.load(std::memory_order_relaxed); }

  /// A fraction above 0 by which a state shows that it was stepped with this text, the same in every process.
  double mark() const { return mark_; }

  /// Announces that there may be another model. Any thread may call it.
  static void Prepared() { ++count_; }

 private:
  bool SameBlocks(std::string_view text) const;

  inline static std::atomic<uint64_t> count_{1};  // of calls of Prepared

  std::string copy_;
  double mark_;
  uint64_t prepared_ = 0;  // count of calls when all of it was compared
};

}  // namespace warmjoint

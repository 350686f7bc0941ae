// Whether a model still holds the attributes that an instance was bound to.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>

namespace warmjoint::inline sim {

/// Remembers a text. A model that was freed may have left its place in memory to another one, whose
/// text then stands there; nothing but the text itself tells that.
class AttributeWatch {
 public:
  explicit AttributeWatch(std::string_view text);

  /// Whether this is the text. All of it is compared where it is short, or where an instance has
  /// been prepared since (Prepared), as each compilation and each new mjData do; of longer texts
  /// that no compilation or mjData announced, blocks that are spread over it.
  bool Same(std::string_view text);

  /// Whether no compilation and no mjData was announced since all of it was compared.
  bool Quiet() const { return prepared_ == count_.load(std::memory_order_relaxed); }

  /// What tells the text from others in a state: a fraction above 0, the same in every process.
  double mark() const { return mark_; }

  /// Tells all watches that there may be another model. Any thread may call it.
  static void Prepared() { ++count_; }

 private:
  bool SameBlocks(std::string_view text) const;

  inline static std::atomic<uint64_t> count_{1};  // of calls of Prepared

  std::string copy_;
  double mark_;
  uint64_t prepared_ = 0;  // count of calls when all of it was compared
};

}  // namespace warmjoint::inline sim

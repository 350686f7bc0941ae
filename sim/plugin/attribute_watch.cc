#include "sim/plugin/attribute_watch.h"

#include <cmath>
#include <cstring>

namespace warmjoint::inline sim {
namespace {

constexpr size_t kShort = 2048;  // bytes
constexpr size_t kBlock = 64, kBlocks = 16;

/// FNV-1a of 64 bits, of which a double bears 53.
double MarkOf(std::string_view text) {
  uint64_t hash = 14695981039346656037u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return std::ldexp(static_cast<double>((hash >> 11) | 1), -53);
}

}  // namespace

AttributeWatch::AttributeWatch(std::string_view text) : copy_(text), mark_(MarkOf(text)) {}

bool AttributeWatch::Same(std::string_view text) {
  // of a long text blocks are enough, unless something was prepared since all was compared
  if (text.size() != copy_.size()) return false;
  const uint64_t count = count_.load(std::memory_order_relaxed);
  if (text.size() > kShort && prepared_ == count) return SameBlocks(text);
  const bool same = std::memcmp(text.data(), copy_.data(), text.size()) == 0;
  if (same) prepared_ = count;
  return same;
}

bool AttributeWatch::SameBlocks(std::string_view text) const {
  // blocks from the first byte to the last, evenly
  const size_t stride = (text.size() - kBlock) / (kBlocks - 1);
  bool same = true;
  for (size_t i = 0; i < kBlocks; ++i) {
    same &= std::memcmp(text.data() + i * stride, copy_.data() + i * stride, kBlock) == 0;
  }
  return same;
}

}  // namespace warmjoint::inline sim

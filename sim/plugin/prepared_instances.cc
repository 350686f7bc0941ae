#include "sim/plugin/prepared_instances.h"

#include <cmath>
#include <cstring>
#include <deque>
#include <mutex>
#include <unordered_map>

#include "sim/plugin/plugin_instances.h"

namespace warmjoint {
namespace {

/// Attribute text that is kept at most, bytes. A map's tables take some twenty times its text.
constexpr size_t kMostText = size_t{1} << 21;

/// Instances by what describes them; the oldest make room for new ones.
class Shelf {
 public:
  std::shared_ptr<const PreparedInstance> Find(const std::string& key) {
    const std::lock_guard lock(mutex_);
    const auto found = instances_.find(key);
    return found == instances_.end() ? nullptr : found->second;
  }

  void Keep(const std::string& key, std::shared_ptr<const PreparedInstance> instance) {
    // the oldest leave until the rest fits, but for the newest
    const std::lock_guard lock(mutex_);
    if (!instances_.emplace(key, std::move(instance)).second) return;
    order_.push_back(key);
    text_ += key.size();
    while (text_ > kMostText && order_.size() > 1) {
      text_ -= order_.front().size();
      instances_.erase(order_.front());
      order_.pop_front();
    }
  }

 private:
  std::mutex mutex_;
  std::unordered_map<std::string, std::shared_ptr<const PreparedInstance>> instances_;
  std::deque<std::string> order_;
  size_t text_ = 0;  // of all keys, bytes
};

constexpr size_t kShort = 2048;  // bytes
constexpr size_t kBlock = 64, kBlocks = 16;

/// FNV-1a of 64 bits, of which a double bears 53.
double MarkOf(std::string_view text) {
  uint64_t hash = 14695981039346656037u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return std::ldexp(static_cast<double>((hash >> 11) | 1), -53);
}

}  // namespace

std::shared_ptr<const PreparedInstance> PrepareInstance(const mjModel* m, int instance) {
  AttributeWatch::Prepared();
  AttributeTexts texts;
  for (const std::string& name : AttributeNames()) {
    const char* text = mj_getPluginConfig(m, instance, name.c_str());
    if (text && text[0]) texts[name] = text;
  }
  // the same text and the same file are prepared once
  const std::string key = std::string(AttributeText(m, instance)) + FileStamp(texts);
  static Shelf shelf;
  if (auto known = shelf.Find(key)) return known;

  auto prepared = std::make_shared<PreparedInstance>();
  if (texts.contains("instance")) prepared->written_name = texts.at("instance");
  const Place place{InstanceName(m, instance)};
  for (const auto& [name, joint] : DescribeJoints(texts, place)) {
    prepared->joints.emplace(
        name, PreparedJoint{joint.friction, JointFriction(joint.friction), joint.initial_energy});
  }
  prepared->options = OptionsIn(texts, place);
  shelf.Keep(key, prepared);
  return prepared;
}

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

}  // namespace warmjoint

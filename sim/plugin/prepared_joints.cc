#include "sim/plugin/prepared_joints.h"

#include <deque>
#include <mutex>
#include <unordered_map>

#include "sim/plugin/attribute_watch.h"

namespace warmjoint::inline sim {
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

Shelf& TheShelf() {
  static Shelf shelf;
  return shelf;
}

}  // namespace

std::shared_ptr<const PreparedInstance> PrepareInstance(const mjModel* m, int instance,
                                                        const Place& place) {
  AttributeWatch::Prepared();
  const auto read = [&](const std::string& name) -> std::string {
    const char* text = mj_getPluginConfig(m, instance, name.c_str());
    return text ? text : "";
  };
  // the same text and the same file are prepared once
  const std::string key = std::string(AttributeText(m, instance)) + FileStamp(read);
  if (auto known = TheShelf().Find(key)) return known;

  auto prepared = std::make_shared<PreparedInstance>();
  prepared->written_name = read("instance");
  const FrictionOfJoints joints = ReadAttributes(read, place);
  for (const auto& [joint, friction] : joints) {
    prepared->joints.emplace(joint, PreparedJoint{friction, JointFriction(friction)});
  }
  for (const auto& [joint, energy] : ReadInitialEnergy(read, joints, place)) {
    prepared->joints.at(joint).initial_energy = energy;
  }
  TheShelf().Keep(key, prepared);
  return prepared;
}

}  // namespace warmjoint::inline sim

#include "sim/model/engine_warnings.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cctype>
#include <mutex>
#include <string_view>
#include <utility>
#include <vector>

#include "models/foundation/excerpt.h"

namespace warmjoint {
namespace {

/// Who takes warnings, and the handler that was there before them.
struct Takers {
  std::mutex mutex;
  std::vector<EngineWarnings*> all;
  void (*before)(const char*) = nullptr;
};

Takers& TakersOfAll() {
  static Takers takers;
  return takers;
}

/// A warning without its numbers, as that of another moment.
std::string KindOf(std::string_view warning) {
  std::string kind;
  std::ranges::copy_if(warning, std::back_inserter(kind),
                       [](char c) { return std::isdigit(static_cast<unsigned char>(c)) == 0; });
  return kind;
}

}  // namespace

EngineWarnings::EngineWarnings(Take take) : take_(std::move(take)) {
  Takers& takers = TakersOfAll();
  const std::lock_guard held(takers.mutex);
  if (takers.all.empty()) takers.before = std::exchange(mju_user_warning, &Deliver);
  takers.all.push_back(this);
}

EngineWarnings::~EngineWarnings() {
  Takers& takers = TakersOfAll();
  const std::lock_guard held(takers.mutex);
  std::erase(takers.all, this);
  // a handler that someone else set meanwhile stays
  if (takers.all.empty() && mju_user_warning == &Deliver) mju_user_warning = takers.before;
}

void EngineWarnings::Deliver(const char* warning) {
  Takers& takers = TakersOfAll();
  const std::lock_guard held(takers.mutex);
  for (EngineWarnings* taker : takers.all) {
    if (!taker->kinds_.insert(KindOf(warning)).second) continue;
    taker->take_("MuJoCo: " + Excerpt(Trimmed(warning), kLongestComplaint));
  }
}

}  // namespace warmjoint

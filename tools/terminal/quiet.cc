#include "tools/terminal/quiet.h"

#include <atomic>

namespace warmjoint::inline tools {
namespace {

std::atomic<bool> quiet{false};  // progress is drawn by a thread of its own

}  // namespace

void BeQuiet() { quiet = true; }

bool IsQuiet() { return quiet; }

}  // namespace warmjoint::inline tools

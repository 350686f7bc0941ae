#include "tools/suite/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

namespace warmjoint::inline tools {
namespace {

/// "45 s", "3 min 20 s", "2 h 5 min".
std::string Duration(double seconds) {
  const auto whole = static_cast<long>(std::lround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace

Progress::Progress(int total, int already)
    : total_(total), already_(already), shown_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (shown_ && finished_ > 0) fmt::print(stderr, "\r\033[K");
}

void Progress::Add(int finished) {
  finished_ += finished;
  const Clock::time_point now = Clock::now();
  if (!shown_ || now - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = now;
  fmt::print(stderr, "\r\033[K{}", Line(std::chrono::duration<double>(now - start_).count()));
  std::fflush(stderr);
}

std::string Progress::Line(double seconds) const {
  std::string line = fmt::format("{}/{} realizations", already_ + finished_, total_);
  if (finished_ > 0 && seconds > 0) {
    const double rate = finished_ / seconds;
    const int open = total_ - already_ - finished_;
    line += fmt::format(", {:.3g}/s, {} left", rate, Duration(open / rate));
  }
  const char* separator = ", failures: ";
  for (const auto& [status, count] : failures_) {
    line += fmt::format("{}{} {}", separator, status, count);
    separator = ", ";
  }
  return line;
}

}  // namespace warmjoint::inline tools

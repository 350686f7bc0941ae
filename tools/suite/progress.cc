#include "tools/suite/progress.h"

#include <fmt/format.h>

namespace warmjoint {

void Progress::Add(int finished) {
  finished_ += finished;
  if (line_.Due()) line_.Show(Line(line_.seconds()));
}

std::string Progress::Line(double seconds) const {
  std::string line = fmt::format("{}/{} realizations", already_ + finished_, total_);
  // how long the rest takes at the speed of this run
  if (finished_ > 0 && seconds > 0) {
    const double rate = finished_ / seconds;
    const int open = total_ - already_ - finished_;
    line += fmt::format(", {:.3g}/s, {} left", rate, DurationInWords(open / rate));
  }
  // failures by their kind
  const char* separator = ", failures: ";
  for (const auto& [status, count] : failures_) {
    line += fmt::format("{}{} {}", separator, status, count);
    separator = ", ";
  }
  return line;
}

}  // namespace warmjoint

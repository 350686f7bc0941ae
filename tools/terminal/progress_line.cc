#include "tools/terminal/progress_line.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "tools/terminal/quiet.h"
#include "tools/terminal/wrap.h"

namespace warmjoint::inline tools {
namespace {

constexpr std::chrono::milliseconds kOnTerminal{100};
constexpr std::chrono::milliseconds kElsewhere{10'000};

/// A progress that cannot be told is no reason to stop.
void Put(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace

ProgressLine::ProgressLine() = default;

ProgressLine::~ProgressLine() { Clear(); }

bool ProgressLine::Due() const {
  return !IsQuiet() && Clock::now() - last_ >= (terminal_ ? kOnTerminal : kElsewhere);
}

void ProgressLine::Show(const std::string& words) {
  last_ = Clock::now();
  drawn_ = true;
  // the last column stays free: some terminals go to the next row once it is filled
  Put(terminal_ ? "\r\033[K" + CutToWidth(words, PageOf(stderr).width - 1) : words + "\n");
}

void ProgressLine::Clear() {
  if (terminal_ && drawn_) Put("\r\033[K");
  drawn_ = false;
}

double ProgressLine::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

std::string DurationInWords(double seconds) {
  // in the two largest units; a bound keeps the rounding within a long
  const auto whole = static_cast<long>(std::lround(std::min(seconds, 1e15)));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace warmjoint::inline tools

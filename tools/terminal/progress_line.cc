#include "tools/terminal/progress_line.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace warmjoint {
namespace {

constexpr std::chrono::milliseconds kOnTerminal{100};
constexpr std::chrono::milliseconds kElsewhere{10'000};
constexpr std::chrono::milliseconds kFirstActivity{1000};
constexpr std::chrono::milliseconds kNextActivity{200};

/// A progress that cannot be written is no reason to stop.
void Put(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

void ReportInterrupt(int signal) {
  // what a handler of signals may do: write, and end by the same signal
  constexpr std::string_view words = "\ninterrupted: what is not finished is not written\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, words.data(), words.size());
  ::signal(signal, SIG_DFL);
  raise(signal);
}

}  // namespace

ProgressLine::~ProgressLine() { Clear(); }

bool ProgressLine::Due() const {
  return !IsQuiet() && Clock::now() - last_ >= (terminal_ ? kOnTerminal : kElsewhere);
}

void ProgressLine::Show(const std::string& words) {
  last_ = Clock::now();
  drawn_ = true;
  // the last column stays free: some terminals go to the next row once it is filled
  Put(terminal_ ? fmt::format("\r\033[K{:.{}}", words, PageOf(stderr).width - 1) : words + "\n");
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

Activity::Activity(std::string words) : words_(std::move(words)) {
  // who ignores interrupts, as under nohup, goes on ignoring them
  earlier_ = signal(SIGINT, ReportInterrupt);
  if (earlier_ == SIG_IGN) signal(SIGINT, SIG_IGN);

  // a thread of its own draws, since the work has no time for it
  thread_ = std::jthread([this](const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    // short work ends without a line
    changed_.wait_for(lock, stop, kFirstActivity, [] { return false; });
    while (!stop.stop_requested()) {
      if (line_.Due()) {
        line_.Show(fmt::format("{}, {}", words_, DurationInWords(line_.seconds())));
      }
      changed_.wait_for(lock, stop, kNextActivity, [] { return false; });
    }
  });
}

Activity::~Activity() {
  thread_.request_stop();
  thread_.join();
  signal(SIGINT, earlier_);
}

void Activity::Is(std::string words) {
  const std::lock_guard lock(mutex_);
  words_ = std::move(words);
}

void Activity::Aside(const std::function<void()>& print) {
  // the line makes room, and comes again with the next step
  const std::lock_guard lock(mutex_);
  line_.Clear();
  print();
}

}  // namespace warmjoint

#include "tools/terminal/activity.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <string_view>
#include <utility>

namespace warmjoint::inline tools {
namespace {

constexpr std::chrono::milliseconds kPatience{1000};  // before the first line
constexpr std::chrono::milliseconds kStep{200};

void TellInterrupt(int signal) {
  // what a handler of signals may do: write, and end by the same signal
  constexpr std::string_view words = "\ninterrupted: what is not finished is not written\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, words.data(), words.size());
  ::signal(signal, SIG_DFL);
  raise(signal);
}

}  // namespace

Activity::Activity(std::string words) : words_(std::move(words)) {
  // who ignores interrupts, as under nohup, goes on ignoring them
  earlier_ = signal(SIGINT, TellInterrupt);
  if (earlier_ == SIG_IGN) signal(SIGINT, SIG_IGN);

  // a thread of its own draws, since the work has no time for it
  thread_ = std::jthread([this](const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    // short work ends without a line
    changed_.wait_for(lock, stop, kPatience, [] { return false; });
    while (!stop.stop_requested()) {
      Draw();
      changed_.wait_for(lock, stop, kStep, [] { return false; });
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

void Activity::Draw() {
  if (line_.Due()) {
    line_.Show(fmt::format("{}, {}", words_, DurationInWords(line_.seconds())));
  }
}

}  // namespace warmjoint::inline tools

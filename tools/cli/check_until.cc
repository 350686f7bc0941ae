#include "tools/cli/check_until.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>
#include <warmjoint/prepared_log.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <functional>
#include <string_view>
#include <system_error>
#include <thread>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/serialize.h"
#include "models/recording/log_formats.h"
#include "models/recording/read_recording.h"
#include "tools/design/aim.h"
#include "tools/identify/recording_source.h"
#include "tools/terminal/progress_line.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

/// What is known after some minutes, in a line.
std::string Words(const Sufficiency& found, const DesignAim& aim) {
  const std::string goal = TextOf(aim);
  if (found.reached) {
    return fmt::format("{} is there after {:.3g} min: the 95 % interval is {:.2g} % to either side",
                       goal, found.minutes, 100 * *found.half_width);
  }
  if (!found.half_width) {
    return fmt::format(
        "{} is not there after {:.3g} min: {}", goal, found.minutes,
        found.status == Status::ok ? "the answer has no such interval" : found.message);
  }
  const std::string more =
      found.minutes_more
          ? fmt::format("about {:.3g} min more of this motion", *found.minutes_more)
          : fmt::format("this motion will take too long: `warmjoint design --for {}` finds another",
                        goal);
  return fmt::format("{} is not there after {:.3g} min: {:.2g} %, {}", goal, found.minutes,
                     100 * *found.half_width, more);
}

/// A text that is written to while it is read: a file, or what comes through standard input.
class GrowingText {
 public:
  explicit GrowingText(const std::string& file)
      : name_(InputName(file)),
        pipe_(IsStandardInput(file)),
        file_(pipe_ ? STDIN_FILENO : open(file.c_str(), O_RDONLY | O_NOCTTY | O_CLOEXEC)) {
    struct stat status {};
    if (file_ < 0 || fstat(file_, &status) != 0) {
      Refuse({name_}, "cannot be read ({}); does it exist?",
             std::generic_category().message(errno));
    }
    if (!pipe_ && !S_ISREG(status.st_mode)) {
      Refuse({name_}, "is no file; give one, or - for what comes through a pipe");
    }
  }
  ~GrowingText() {
    if (!pipe_) close(file_);
  }
  GrowingText(const GrowingText&) = delete;
  GrowingText& operator=(const GrowingText&) = delete;

  /// The rows that are whole: a recorder may stop writing in the middle of one.
  std::string_view rows() const { return std::string_view(text_).substr(0, text_.rfind('\n') + 1); }

  /// Waits until another row is whole; false where none has come for a while, and at the end of a pipe.
  bool Waits() {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::seconds kPatience{
        60};  // why: longer than a recorder keeps lines to itself
    const size_t before = rows().size();
    for (const auto end = Clock::now() + kPatience; Clock::now() < end;) {
      const bool ended = !Take() && pipe_;
      if (rows().size() > before) return true;
      if (ended) return false;
      if (!pipe_) std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
    return false;
  }

 private:
  /// Reads what there is; false where nothing more comes as yet.
  bool Take() {
    std::array<char, 1 << 16> block;
    pollfd one{file_, POLLIN, 0};
    // a file is ready at its end, too
    while (poll(&one, 1, pipe_ && text_.size() == taken_ ? 200 : 0) > 0) {
      const ssize_t n = read(file_, block.data(), block.size());
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) Refuse({name_}, "cannot be read ({})", std::generic_category().message(errno));
      if (n == 0) return false;
      text_.append(block.data(), static_cast<size_t>(n));
    }
    taken_ = text_.size();
    return true;
  }

  std::string name_, text_;
  bool pipe_;
  int file_;
  size_t taken_ = 0;  // of the text, that earlier calls found
};

/// Looks each time that another part of a recording has come.
Sufficiency Watch(const DesignAim& aim, const UntilArguments& arguments,
                  const RecordingSource& recording,
                  const std::function<void(const Sufficiency&)>& looked) {
  if (recording.files.size() != 1) Refuse({"--watch"}, "is for one recording");
  const std::string& file = recording.files.front();
  RequireReadable(file);
  if (MayHoldObjects(file)) {
    Refuse({"--watch"}, "reads tables of text while they are written, not {}; record a .csv",
           FormatOf(file).name);
  }
  constexpr long kFewest = 30;  // why: no fit is made of fewer samples
  GrowingText text(file);
  Sufficiency found;
  for (bool grows = true; grows && !found.reached;) {
    grows = text.Waits();
    // a file that ends after a few rows says why it is none
    const std::string_view rows = text.rows();
    if (grows && std::ranges::count(rows, '\n') < kFewest) continue;
    if (!grows && found.minutes > 0) break;
    const auto logs = MakeRecordings(rows, recording.read, InputName(file));
    found = LookWhether(Prepare(logs, recording.prepare), aim, arguments.identify);
    looked(found);
  }
  return found;
}

}  // namespace

ExitStatus CheckUntil(const UntilArguments& arguments, const RecordingSource& recording,
                      const std::string& format) {
  const DesignAim aim = GoalFrom(arguments.goal);
  Activity activity("reading the recording");
  const auto say = [&](const Sufficiency& found) {
    if (format != "text") return;
    activity.Aside([&] { Say(stdout, "{}\n", Words(found, aim)); });
    std::fflush(stdout);
  };
  Sufficiency found;
  if (arguments.watch) {
    found = Watch(aim, arguments, recording, say);
  } else {
    found =
        LookUntil(ReadAndPrepare(recording), aim, arguments.identify, [&](const Sufficiency& part) {
          activity.Is(fmt::format("looking at the first {:.3g} min", part.minutes));
        });
    say(found);
  }
  if (format == "json") {
    activity.Aside([&] { fmt::print("{}\n", WriteFields(found).dump(2)); });
  }
  return found.reached ? ExitStatus::done : ExitStatus::nothing_trustworthy;
}

}  // namespace warmjoint

#include "models/recording/read_apart.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"

namespace warmjoint {
namespace {

constexpr std::size_t kMemory = std::size_t{8} << 30;       // bytes, of the child alone
constexpr std::size_t kLongestText = std::size_t{1} << 20;  // bytes of a name, unit or refusal
constexpr std::uint64_t kMostColumns = 100'000;
constexpr char kContent = 'c', kRefusal = 'r';

/// Bytes of an answer: first kContent or kRefusal, then numbers and texts as they come.
class Answer {
 public:
  void Put(std::uint64_t number) { Put(&number, sizeof number); }
  void Put(const std::string& text) {
    Put(std::uint64_t{text.size()});
    Put(text.data(), text.size());
  }
  void Put(const Eigen::VectorXd& values) {
    Put(static_cast<std::uint64_t>(values.size()));
    Put(values.data(), static_cast<std::size_t>(values.size()) * sizeof(double));
  }
  void Put(const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  }

  std::string bytes;
};

/// Takes an answer apart. A child that a file took over may have sent anything: every length is
/// checked before it is believed.
class AnswerReader {
 public:
  AnswerReader(std::string_view bytes, const char* format, const Place& place)
      : rest_(bytes), format_(format), place_(place) {}

  std::uint64_t Number(std::uint64_t most) {
    std::uint64_t number = 0;
    std::memcpy(&number, Take(sizeof number).data(), sizeof number);
    if (number > most) RefuseAnswer();
    return number;
  }
  std::string Text() { return std::string(Take(Number(kLongestText))); }
  Eigen::VectorXd Values() {
    const std::uint64_t count = Number(kMostSamples);
    const std::string_view bytes = Take(count * sizeof(double));
    Eigen::VectorXd values(static_cast<Eigen::Index>(count));
    if (count > 0) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
  std::string_view Take(std::size_t size) {
    if (size > rest_.size()) RefuseAnswer();
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }

 private:
  [[noreturn]] void RefuseAnswer() const {
    Refuse(place_, "cannot be read as {}: its reader broke off; the file is damaged", format_);
  }

  std::string_view rest_;
  const char* format_;
  const Place& place_;
};

std::string Packed(const FileContent& content) {
  Answer answer;
  answer.Put(&kContent, 1);
  answer.Put(content.joint);
  // the gear, whether there is one or not
  answer.Put(std::uint64_t{content.gear.has_value()});
  const double gear = content.gear.value_or(0);
  answer.Put(&gear, sizeof gear);
  answer.Put(std::uint64_t{content.columns.size()});
  for (const FileColumn& column : content.columns) {
    answer.Put(column.name);
    answer.Put(column.unit);
    answer.Put(column.values);
  }
  return std::move(answer.bytes);
}

FileContent Unpacked(AnswerReader& reader) {
  // in the order in which they were packed
  FileContent content;
  content.joint = reader.Text();
  const bool has_gear = reader.Number(1) == 1;
  double gear = 0;
  std::memcpy(&gear, reader.Take(sizeof gear).data(), sizeof gear);
  if (has_gear) content.gear = gear;
  content.columns.resize(reader.Number(kMostColumns));
  for (FileColumn& column : content.columns) {
    column.name = reader.Text();
    column.unit = reader.Text();
    column.values = reader.Values();
  }
  return content;
}

/// Bytes of address space that this process has.
std::size_t OwnMemory() {
  std::size_t pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "re")) {
    if (std::fscanf(file, "%zu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void Limit(int resource, rlim_t value) {
  rlimit limit{};
  getrlimit(static_cast<__rlimit_resource>(resource), &limit);
  limit.rlim_cur = std::min(value, limit.rlim_max);
  setrlimit(static_cast<__rlimit_resource>(resource), &limit);
}

/// The child's whole life: reads within its limits, answers, and ends without its parent's farewells.
[[noreturn]] void ReadInChild(const FileFormat& format, const std::string& path,
                              const ReadSettings& layout, double seconds, int out) {
  // limits on memory and time, and no core file
  Limit(RLIMIT_AS, OwnMemory() + kMemory);
  Limit(RLIMIT_CPU, static_cast<rlim_t>(std::ceil(seconds)));
  Limit(RLIMIT_CORE, 0);
  // what the library or malloc cries out is of no use to anyone
  dup2(open("/dev/null", O_WRONLY | O_CLOEXEC), STDERR_FILENO);
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL}) ::signal(signal, SIG_DFL);

  // what was read, or why nothing was
  std::string answer;
  try {
    answer = Packed(format.read(path, layout));
  } catch (const BadInput& refusal) {
    answer = kRefusal + std::string(refusal.what());
  } catch (const std::exception& error) {
    answer =
        kRefusal + fmt::format("{}: cannot be read as {}: {}", path, format.name, error.what());
  }
  // the pipe takes a part at a time
  for (std::string_view rest = answer; !rest.empty();) {
    const ssize_t written = write(out, rest.data(), rest.size());
    if (written < 0 && errno != EINTR) break;
    if (written > 0) rest.remove_prefix(static_cast<std::size_t>(written));
  }
  _exit(0);
}

/// All that comes through a pipe within some seconds; false where it is not at its end by then.
bool ReadAll(int in, double seconds, std::string& bytes) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  // block by block, until the child closes its end or the time is over
  std::array<char, 1 << 16> block;
  for (;;) {
    const std::chrono::duration<double, std::milli> left = end - Clock::now();
    pollfd readable{in, POLLIN, 0};
    const int ready = poll(&readable, 1, static_cast<int>(std::max(0.0, std::ceil(left.count()))));
    if (ready == 0 || left.count() <= 0) return false;
    if (ready < 0 && errno != EINTR) return false;
    if (ready < 0) continue;
    const ssize_t n = read(in, block.data(), block.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return n == 0;
    bytes.append(block.data(), static_cast<std::size_t>(n));
  }
}

}  // namespace

FileContent ReadApart(const FileFormat& format, const std::string& path, const ReadSettings& layout,
                      double patience) {
  // larger files may take longer
  std::error_code absent;
  const auto size = std::filesystem::file_size(path, absent);
  const double seconds = patience + (absent ? 0 : 1e-7 * static_cast<double>(size));
  // the child reads, and answers through a pipe
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  const pid_t child = fork();
  if (child == 0) ReadInChild(format, path, layout, seconds, ends[1]);
  close(ends[1]);
  std::string bytes;
  const bool whole = child > 0 && ReadAll(ends[0], std::min(2 * seconds, seconds + 5), bytes);
  close(ends[0]);
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  // a child that is not at its end by then is killed, and none is left behind
  if (!whole) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;

  // why there may be no answer
  const Place place{path};
  const bool late = !whole || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU);
  if (late) {
    Refuse(place, "cannot be read as {} within {:.3g} s; the file is damaged, or too large",
           format.name, seconds);
  }
  if (!WIFEXITED(status)) {
    Refuse(place, "cannot be read as {}: the library crashed on it (signal {}); it is damaged",
           format.name, WTERMSIG(status));
  }
  // the answer, which may be a refusal
  AnswerReader reader(bytes, format.name, place);
  const char kind = reader.Take(1)[0];
  if (kind == kRefusal) throw BadInput(bytes.substr(1, kLongestText));
  return Unpacked(reader);
}

}  // namespace warmjoint

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
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "models/foundation/bad_input.h"
#include "models/recording/read_recording.h"

namespace warmjoint {
namespace {

constexpr std::size_t kMemory = std::size_t{8} << 30;       // bytes, of the child alone
constexpr std::size_t kLongestText = std::size_t{1} << 20;  // bytes of a name, unit or refusal
constexpr std::size_t kMostColumns = 100'000;
constexpr char kContent = 'c', kRefusal = 'r';

/// Puts an answer together: first kContent or kRefusal, then sizes and what has them.
struct Packer {
  std::size_t Size(std::size_t size, std::size_t /*most*/) {
    bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
    return size;
  }
  template <typename Range>
  void Put(Range& range, std::size_t most) {
    const std::size_t size = Size(static_cast<std::size_t>(range.size()), most);
    bytes.append(reinterpret_cast<const char*>(range.data()), size * sizeof(*range.data()));
  }

  std::string bytes;
};

/// Takes it apart. A child that a file took over may have sent anything: every size is checked before it is believed.
struct Unpacker {
  std::size_t Size(std::size_t /*ours*/, std::size_t most) {
    std::size_t size = 0;
    std::memcpy(&size, Take(sizeof size).data(), sizeof size);
    if (size > most) RefuseAnswer();
    return size;
  }
  template <typename Range>
  void Put(Range& range, std::size_t most) {
    const std::size_t size = Size(0, most);
    const std::string_view bytes = Take(size * sizeof(*range.data()));
    range.resize(static_cast<decltype(range.size())>(size));
    if (size > 0) std::memcpy(range.data(), bytes.data(), bytes.size());
  }
  std::string_view Take(std::size_t size) {
    if (size > rest.size()) RefuseAnswer();
    const std::string_view taken = rest.substr(0, size);
    rest.remove_prefix(size);
    return taken;
  }
  [[noreturn]] void RefuseAnswer() const {
    Refuse(place, "cannot be read as {}: its reader broke off; the file is damaged", format);
  }

  std::string_view rest;
  const char* format;
  const Place& place;
};

/// What a file holds, part by part, at either end of the pipe.
template <typename End>
void Exchange(End& end, FileContent& content) {
  end.Put(content.joint, kLongestText);
  // the gear, whether there is one or not
  std::vector<double> gear;
  if (content.gear) gear.push_back(*content.gear);
  end.Put(gear, 1);
  if (!gear.empty()) content.gear = gear[0];
  for (std::vector<std::string>* lines : {&content.notes, &content.doubts}) {
    lines->resize(end.Size(lines->size(), kMostColumns));
    for (std::string& line : *lines) end.Put(line, kLongestText);
  }
  content.columns.resize(end.Size(content.columns.size(), kMostColumns));
  for (FileColumn& column : content.columns) {
    end.Put(column.name, kLongestText);
    end.Put(column.unit, kLongestText);
    end.Put(column.values, kMostSamples);
  }
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
                              const WantedColumns& wanted, double seconds, int out) {
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
    FileContent content = format.read(path, wanted);
    Packer packer{std::string(1, kContent)};
    Exchange(packer, content);
    answer = std::move(packer.bytes);
  } catch (const BadInput& refusal) {
    answer = kRefusal + std::string(refusal.what());
  } catch (const std::exception& error) {
    answer =
        kRefusal + fmt::format("{}: cannot be read as {}: {}", path, format.name, error.what());
  }
  // the parent learns it through the pipe
  if (std::FILE* const pipe = fdopen(out, "w")) {
    std::fwrite(answer.data(), 1, answer.size(), pipe);
    std::fclose(pipe);
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

FileContent ReadApart(const FileFormat& format, const std::string& path,
                      const WantedColumns& wanted, double patience) {
  // larger files may take longer
  std::error_code absent;
  const auto size = std::filesystem::file_size(path, absent);
  const double seconds = patience + (absent ? 0 : 1e-7 * static_cast<double>(size));
  // the child reads, and answers through a pipe
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  const pid_t child = fork();
  if (child == 0) ReadInChild(format, path, wanted, seconds, ends[1]);
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
  Unpacker reader{bytes, format.name, place};
  if (reader.Take(1)[0] == kRefusal) throw BadInput(bytes.substr(1, kLongestText));
  FileContent content;
  Exchange(reader, content);
  return content;
}

}  // namespace warmjoint

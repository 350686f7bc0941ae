#include "models/foundation/spare_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <sstream>

namespace warmjoint::inline models {
namespace {

constexpr std::uint64_t kUnknown = std::numeric_limits<std::uint64_t>::max();

/// The first number of a file; kUnknown for no file and for "max".
std::uint64_t NumberIn(const std::string& path) {
  std::uint64_t number = 0;
  return std::ifstream(path) >> number ? number : kUnknown;
}

/// Of the whole system, without what would have to be swapped.
std::uint64_t Available() {
  std::ifstream file("/proc/meminfo");
  for (std::string name; file >> name;) {
    std::uint64_t kibibytes = 0;
    if (name == "MemAvailable:" && file >> kibibytes) return kibibytes << 10;
    std::getline(file, name);
  }
  return kUnknown;
}

/// Of the control group of either version. What it has taken is not subtracted: most of that is cache.
std::uint64_t GroupLimit() {
  std::uint64_t least = kUnknown;
  std::ifstream file("/proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    // number:controllers:group; version 2 names no controllers
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const std::string group = line.substr(second + 1);
    // version 2 and version 1 keep the limit in different places
    if (controllers.empty()) {
      least = std::min(least, NumberIn("/sys/fs/cgroup" + group + "/memory.max"));
    } else if (controllers == "memory") {
      least = std::min(least, NumberIn("/sys/fs/cgroup/memory" + group + "/memory.limit_in_bytes"));
    }
  }
  return least;
}

std::uint64_t SpareAddresses() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnknown;

  // addresses that are taken already count against the limit
  const std::uint64_t pages = NumberIn("/proc/self/statm");
  const std::uint64_t taken =
      pages == kUnknown ? 0 : pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return limit.rlim_cur > taken ? limit.rlim_cur - taken : 0;
}

}  // namespace

std::uint64_t SpareMemory() { return std::min({Available(), GroupLimit(), SpareAddresses()}); }

std::string MemoryInWords(double bytes) {
  static constexpr std::array<const char*, 4> units{"MiB", "GiB", "TiB", "PiB"};
  double size = bytes / (1 << 20);
  std::size_t unit = 0;
  for (; size >= 1024 && unit + 1 < units.size(); ++unit) size /= 1024;
  return fmt::format("{:.3g} {}", size, units[unit]);
}

void RequireMemory(double bytes, std::string_view task, std::string_view remedy,
                   const Place& place) {
  const auto spare = static_cast<double>(SpareMemory());
  if (bytes <= spare) return;
  Refuse(place, "{} take about {} of memory, and {} are free; {}", task, MemoryInWords(bytes),
         MemoryInWords(spare), remedy);
}

}  // namespace warmjoint::inline models

#include "tools/suite/wall.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "tools/suite/bubble.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

/// The kernel's landlock_ruleset_attr; headers of older kernels lack its later members.
struct Ruleset {
  std::uint64_t files = 0;
  std::uint64_t network = 0;  // from version 4
  std::uint64_t scoped = 0;   // from version 6
};

constexpr std::uint64_t kRead = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t kExecute = LANDLOCK_ACCESS_FS_EXECUTE;
constexpr std::uint64_t kFilesOnly = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_WRITE_FILE |
                                     LANDLOCK_ACCESS_FS_EXECUTE | std::uint64_t{1} << 14;
constexpr std::uint64_t kTruncate = std::uint64_t{1} << 14;     // from version 3
constexpr std::uint64_t kDevices = std::uint64_t{1} << 15;      // ioctl; from version 5
constexpr std::uint64_t kRefer = LANDLOCK_ACCESS_FS_REFER;      // from version 2
constexpr std::uint64_t kFirst = (std::uint64_t{1} << 13) - 1;  // all of version 1

/// Folders that an operating system brings.
constexpr const char* kSystem[]{"/usr",   "/bin",    "/sbin", "/lib", "/lib32",
                                "/lib64", "/libx32", "/opt",  "/etc", "/sys/devices/system"};

std::uint64_t Handled(int version) {
  return kFirst | (version >= 2 ? kRefer : 0) | (version >= 3 ? kTruncate : 0) |
         (version >= 5 ? kDevices : 0);
}

/// What a command may do in its own directory: all but make devices.
std::uint64_t OwnAccess(int version) {
  constexpr std::uint64_t forbidden = LANDLOCK_ACCESS_FS_MAKE_CHAR | LANDLOCK_ACCESS_FS_MAKE_BLOCK;
  return Handled(version) & ~forbidden & ~kDevices;
}

/// Lets the wall's inside use a file, or a folder and all below it. Absent ones are left out.
void Allow(int ruleset, const fs::path& path, std::uint64_t access) {
  const int file = open(path.c_str(), O_PATH | O_CLOEXEC);
  if (file < 0) return;
  struct stat status {};
  const bool folder = fstat(file, &status) == 0 && S_ISDIR(status.st_mode);
  landlock_path_beneath_attr rule{};
  // files know fewer rights than folders
  rule.allowed_access = folder ? access : access & kFilesOnly;
  rule.parent_fd = file;
  const long failed = syscall(SYS_landlock_add_rule, ruleset, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  const int error = errno;
  close(file);
  if (failed != 0) throw std::system_error(error, std::generic_category(), "landlock_add_rule");
}

}  // namespace

int WallVersion() {
  static const long version =
      syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  return version > 0 ? static_cast<int>(version) : 0;
}

WallKind BestWall() {
  static const WallKind best = [] {
    const char* wish = std::getenv("WARMJOINT_WALL");
    const bool bubble_first = wish && std::string_view(wish) == "bubblewrap";
    if (bubble_first && !Bubblewrap().empty()) return WallKind::bubblewrap;
    if (WallVersion() > 0) return WallKind::landlock;
    return Bubblewrap().empty() ? WallKind::none : WallKind::bubblewrap;
  }();
  return best;
}

std::string WallInWords() {
  const int version = WallVersion();
  if (BestWall() == WallKind::none) {
    return "no wall stands: this kernel has no Landlock, and bubblewrap is not installed or may "
           "not "
           "work here. Identifiers from outside can read the truth and are trusted not to";
  }
  if (BestWall() == WallKind::bubblewrap) {
    return "wall: bubblewrap: identifiers from outside see their own directory, the system's files "
           "and their own processes";
  }
  return fmt::format(
      "wall: Landlock {}: identifiers from outside reach their own directory and the system's "
      "files{}",
      version,
      version >= 6   ? ""
      : version >= 4 ? "; they can signal other processes"
                     : "; they can signal other processes and use the network");
}

bool WallHides(const fs::path& path, const std::vector<fs::path>& readable) {
  if (BestWall() == WallKind::none) return false;
  const fs::path real = fs::weakly_canonical(fs::absolute(path));
  std::vector<fs::path> open(std::begin(kSystem), std::end(kSystem));
  for (const fs::path& one : readable) open.push_back(fs::weakly_canonical(one));
  return std::none_of(open.begin(), open.end(), [&](const fs::path& root) {
    return std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first == root.end();
  });
}

Wall::Wall(const std::vector<fs::path>& readable, const fs::path& own, WallKind kind) {
  // this kind of wall is built around the command when it starts
  if (kind == WallKind::bubblewrap) {
    bubble_ = true;
    readable_ = readable;
    own_ = own;
  }
  const int version = WallVersion();
  if (kind != WallKind::landlock || version == 0) return;
  // what this kernel can forbid: files, from 4 on the network, from 6 on signals too
  const Ruleset attributes{Handled(version), version >= 4 ? std::uint64_t{3} : 0,
                           version >= 6 ? std::uint64_t{3} : 0};
  const size_t size = version >= 6 ? sizeof(Ruleset) : version >= 4 ? 16 : 8;
  const long made = syscall(SYS_landlock_create_ruleset, &attributes, size, 0);
  if (made < 0) throw std::system_error(errno, std::generic_category(), "landlock_create_ruleset");
  ruleset_ = static_cast<int>(made);

  // the system to be read and run, a few devices, and what tells of the machine
  for (const char* folder : kSystem) {
    Allow(ruleset_, folder, kRead | kExecute);
  }
  for (const char* device : {"/dev/null", "/dev/zero", "/dev/full"}) {
    Allow(ruleset_, device, kRead | LANDLOCK_ACCESS_FS_WRITE_FILE);
  }
  for (const char* file :
       {"/dev/random", "/dev/urandom", "/proc/cpuinfo", "/proc/meminfo", "/proc/stat",
        "/proc/sys/kernel/osrelease", "/proc/sys/vm/overcommit_memory", "/proc/filesystems"}) {
    Allow(ruleset_, file, kRead);
  }
  // what the command needs, and the directory that it works in
  for (const fs::path& path : readable) Allow(ruleset_, path, kRead | kExecute);
  Allow(ruleset_, own, OwnAccess(version));
}

Wall::~Wall() {
  if (ruleset_ >= 0) close(ruleset_);
}

std::vector<std::string> Wall::Around(std::vector<std::string> command) const {
  if (!bubble_) return command;
  const std::vector<fs::path> system(std::begin(kSystem), std::end(kSystem));
  return InBubble(command, system, readable_, own_);
}

bool Wall::Raise() const noexcept {
  if (ruleset_ < 0) return true;
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         syscall(SYS_landlock_restrict_self, ruleset_, 0) == 0;
}

}  // namespace warmjoint::inline tools

#include "tools/suite/sandbox.h"

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
#include <system_error>

namespace warmjoint {
namespace fs = std::filesystem;
namespace {

/// The kernel's landlock_ruleset_attr; headers of older kernels lack its later members.
struct Ruleset {
  std::uint64_t files = 0;
  std::uint64_t network = 0;  // from version 4
  std::uint64_t scoped = 0;   // from version 6
};

constexpr std::uint64_t kRead = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t kWrite = LANDLOCK_ACCESS_FS_WRITE_FILE;
constexpr std::uint64_t kExecute = LANDLOCK_ACCESS_FS_EXECUTE;
constexpr std::uint64_t kFirst = (std::uint64_t{1} << 13) - 1;  // all of version 1
constexpr std::uint64_t kRefer = std::uint64_t{1} << 13;        // from version 2
constexpr std::uint64_t kTruncate = std::uint64_t{1} << 14;     // from version 3
constexpr std::uint64_t kDevices = std::uint64_t{1} << 15;      // ioctl; from version 5
constexpr std::uint64_t kNetwork = 3;                           // take and open TCP connections
constexpr std::uint64_t kScopes = 3;  // abstract sockets and signals of processes outside

/// Folders that an operating system brings.
constexpr const char* kSystem[]{"/usr",   "/bin",    "/sbin", "/lib", "/lib32",
                                "/lib64", "/libx32", "/opt",  "/etc", "/sys/devices/system"};

/// What tells of the machine, and random numbers.
constexpr const char* kMachine[]{"/dev/random",
                                 "/dev/urandom",
                                 "/proc/cpuinfo",
                                 "/proc/meminfo",
                                 "/proc/stat",
                                 "/proc/sys/kernel/osrelease",
                                 "/proc/sys/vm/overcommit_memory",
                                 "/proc/filesystems"};

std::uint64_t FileAccess(int version) {
  return kFirst | (version >= 2 ? kRefer : 0) | (version >= 3 ? kTruncate : 0) |
         (version >= 5 ? kDevices : 0);
}

/// What a command may do in its own directory: all but make devices.
std::uint64_t OwnAccess(int version) {
  constexpr std::uint64_t forbidden = LANDLOCK_ACCESS_FS_MAKE_CHAR | LANDLOCK_ACCESS_FS_MAKE_BLOCK;
  return FileAccess(version) & ~forbidden & ~kDevices;
}

/// Allows the use of a file, or of a folder and all below it; 0 or an errno. Absent ones are left out.
int Allow(int ruleset, const char* path, std::uint64_t access) noexcept {
  const int file = open(path, O_PATH | O_CLOEXEC);
  if (file < 0) return 0;
  struct stat status {};
  const bool folder = fstat(file, &status) == 0 && S_ISDIR(status.st_mode);
  landlock_path_beneath_attr rule{};
  // files know fewer rights than folders
  rule.allowed_access =
      folder ? access : access & (LANDLOCK_ACCESS_FS_READ_FILE | kWrite | kExecute | kTruncate);
  rule.parent_fd = file;
  const long failed = syscall(SYS_landlock_add_rule, ruleset, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  const int error = failed == 0 ? 0 : errno;
  close(file);
  return error;
}

}  // namespace

int LandlockVersion() {
  static const long version =
      syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  return version > 0 ? static_cast<int>(version) : 0;
}

std::string DescribeSandbox(Confinement confinement) {
  if (confinement == Confinement::none) {
    return "warning: commands run unconfined: they can read and change all that you can, the truth "
           "included";
  }
  const int version = LandlockVersion();
  const char* gap = version >= 6   ? ""
                    : version >= 4 ? "; this kernel does not stop signals to your other processes"
                    : version >= 3 ? "; this kernel stops neither signals to your other processes "
                                     "nor network connections"
                                   : "; this kernel stops neither signals to your other processes, "
                                     "nor network connections, nor that your files are emptied";
  return fmt::format(
      "sandbox: commands reach their own directory, the files that they name and the system's "
      "(Landlock {}){}",
      version, gap);
}

bool IsAround(const fs::path& folder, const fs::path& path) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

bool SandboxHides(const fs::path& path, const std::vector<fs::path>& readable) {
  const fs::path real = fs::weakly_canonical(fs::absolute(path));
  std::vector<fs::path> open(std::begin(kSystem), std::end(kSystem));
  for (const fs::path& one : readable) open.push_back(fs::weakly_canonical(one));
  return std::ranges::none_of(open, [&](const fs::path& root) { return IsAround(root, real); });
}

Sandbox::Sandbox(const std::vector<fs::path>& readable) {
  // all that this kernel can forbid
  const int version = LandlockVersion();
  const Ruleset attributes{FileAccess(version), version >= 4 ? kNetwork : 0,
                           version >= 6 ? kScopes : 0};
  const size_t size = version >= 6 ? 24 : version >= 4 ? 16 : 8;
  const long made = syscall(SYS_landlock_create_ruleset, &attributes, size, 0);
  if (made < 0) throw std::system_error(errno, std::generic_category(), "landlock_create_ruleset");
  ruleset_ = static_cast<int>(made);

  // of that, what every command may do: use the system, a few devices, and what it names
  const auto allow = [this](const fs::path& path, std::uint64_t access) {
    const int error = Allow(ruleset_, path.c_str(), access);
    if (error != 0) throw std::system_error(error, std::generic_category(), path.string());
  };
  for (const char* folder : kSystem) allow(folder, kRead | kExecute);
  for (const char* file : kMachine) allow(file, kRead);
  for (const char* device : {"/dev/null", "/dev/zero", "/dev/full"}) allow(device, kRead | kWrite);
  for (const fs::path& path : readable) allow(path, kRead | kExecute);
}

Sandbox::~Sandbox() {
  if (ruleset_ >= 0) close(ruleset_);
}

bool Sandbox::Enter(const char* own) const noexcept {
  if (ruleset_ < 0) return true;
  return Allow(ruleset_, own, OwnAccess(LandlockVersion())) == 0 &&
         prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         syscall(SYS_landlock_restrict_self, ruleset_, 0) == 0;
}

}  // namespace warmjoint

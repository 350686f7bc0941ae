// What commands of others can reach: Landlock of the kernel.
#pragma once

#include <warmjoint/suite.h>

#include <filesystem>
#include <string>
#include <vector>

namespace warmjoint {

/// Version of the kernel's Landlock: 0 where there is none; from 3 on it keeps files elsewhere from being emptied, from 4
/// on it closes the network (TCP), from 6 on it stops signals to processes outside.
int LandlockVersion();

/// One sentence on what commands reach, and on what this kernel's version cannot keep from them.
std::string DescribeSandbox(Confinement confinement);

/// Whether `folder` is, or holds, `path`.
bool IsAround(const std::filesystem::path& folder, const std::filesystem::path& path);

/// Whether the sandbox keeps a file or folder out of sight: all but what an operating system brings and what is named
/// as readable.
bool SandboxHides(const std::filesystem::path& path,
                  const std::vector<std::filesystem::path>& readable);

/// Within it a process and its children can read and execute what an operating system brings (/usr, /etc, ...), read
/// what is named as readable, and read and write one directory of their own; they can trace and signal no process
/// outside, and open no connection. /proc is closed, so that no process's memory, arguments, environment or files are
/// within reach.
class Sandbox {
 public:
  /// readable: files and folders; those that do not exist are left out. Throws system_error where the kernel refuses.
  explicit Sandbox(const std::vector<std::filesystem::path>& readable);
  /// None: for what is trusted.
  Sandbox() = default;
  ~Sandbox();
  Sandbox(const Sandbox&) = delete;
  Sandbox& operator=(const Sandbox&) = delete;

  /// Confines the calling process for the rest of its life, with `own` as its directory; false where that fails. Safe
  /// between fork and exec.
  bool Enter(const char* own) const noexcept;

  /// Has to stay open until Enter; -1 without a sandbox.
  int descriptor() const { return ruleset_; }

 private:
  int ruleset_ = -1;
};

}  // namespace warmjoint

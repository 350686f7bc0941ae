#include "models/foundation/atomic_directory.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "models/foundation/bad_input.h"
#include "models/foundation/output_failed.h"

namespace warmjoint::inline models {
namespace fs = std::filesystem;
namespace {

void RefuseForeignContents(const fs::path& target, const std::vector<std::string>& replaceable) {
  if (!fs::exists(target)) return;
  if (!fs::is_directory(target)) Refuse({target.string()}, "is a file; give a directory");
  // nothing may be lost but what may be replaced
  for (const auto& entry : fs::directory_iterator(target)) {
    const std::string name = entry.path().filename();
    if (std::find(replaceable.begin(), replaceable.end(), name) != replaceable.end()) continue;
    Refuse({target.string()}, "holds '{}', which would be lost; choose a new or empty directory",
           name);
  }
}

}  // namespace

AtomicDirectory::AtomicDirectory(const fs::path& target,
                                 const std::vector<std::string>& replaceable) {
  if (target.empty()) Refuse({"output"}, "its name is empty; give the name of a directory");
  if (target == "-") Refuse({"-"}, "several files do not fit standard output; give a directory");
  target_ = fs::absolute(target).lexically_normal();
  // "out/" names the directory out
  if (!target_.has_filename()) target_ = target_.parent_path();
  if (fs::is_directory(target_)) target_ = fs::canonical(target_);
  RefuseForeignContents(target_, replaceable);

  // a drawn name, which nobody can have taken with a link of his
  std::string pattern = target_.parent_path() / ".warmjoint.part.XXXXXX";
  if (!mkdtemp(pattern.data())) {
    if (errno == ENOSPC || errno == EDQUOT) FailOutput(target_.string(), errno);
    Refuse({target_.string()}, "cannot be made: {}; does its parent folder exist?",
           std::generic_category().message(errno));
  }
  temporary_ = pattern;
}

AtomicDirectory::~AtomicDirectory() {
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

void AtomicDirectory::Commit() {
  // mkdtemp lets the user alone in; the finished directory is as open as any that he makes
  struct stat like {};
  const bool older = stat(target_.c_str(), &like) == 0;
  const mode_t mask = umask(077);
  umask(mask);
  const bool opened = chmod(temporary_.c_str(), older ? like.st_mode & 07777 : 0777 & ~mask) == 0;

  // an older directory changes places with the new one in one step; the destructor removes it
  const unsigned flags = older ? RENAME_EXCHANGE : 0;
  if (!opened || renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), flags) != 0) {
    FailOutput(target_.string(), errno);
  }
}

}  // namespace warmjoint::inline models

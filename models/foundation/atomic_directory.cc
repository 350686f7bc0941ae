#include "models/foundation/atomic_directory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "models/foundation/bad_input.h"

namespace warmjoint::inline models {
namespace fs = std::filesystem;
namespace {

void RefuseForeignContents(const fs::path& target, const std::vector<std::string>& replaceable) {
  if (!fs::exists(target)) return;
  if (!fs::is_directory(target)) Refuse({target.string()}, "is a file; give a directory");
  for (const auto& entry : fs::directory_iterator(target)) {
    const std::string name = entry.path().filename();
    if (std::find(replaceable.begin(), replaceable.end(), name) != replaceable.end()) continue;
    Refuse({target.string()}, "holds '{}', which would be lost; choose a new or empty directory",
           name);
  }
}

}  // namespace

AtomicDirectory::AtomicDirectory(fs::path target, const std::vector<std::string>& replaceable)
    : target_(fs::absolute(target).lexically_normal()) {
  // "out/" names the directory out
  if (!target_.has_filename()) target_ = target_.parent_path();
  RefuseForeignContents(target_, replaceable);

  temporary_ =
      target_.parent_path() / fmt::format(".{}.{}.part", target_.filename().string(), getpid());
  std::error_code error;
  fs::create_directory(temporary_, error);
  if (error) {
    Refuse({target_.string()}, "cannot be made: {}; does its parent folder exist?",
           error.message());
  }
}

AtomicDirectory::~AtomicDirectory() {
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

void AtomicDirectory::Commit() {
  // an older directory changes places with the new one in one step; the destructor removes it
  const unsigned flags = fs::exists(target_) ? RENAME_EXCHANGE : 0;
  if (renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), flags) != 0) {
    Refuse({target_.string()}, "cannot be written: {}", std::strerror(errno));
  }
}

}  // namespace warmjoint::inline models

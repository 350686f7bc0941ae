#include "models/foundation/atomic_file.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "models/foundation/bad_input.h"
#include "models/foundation/output_failed.h"

namespace warmjoint::inline models {
namespace fs = std::filesystem;
namespace {

std::string Words(int error) { return std::generic_category().message(error); }

/// The mode that a new file gets: what the user's mask leaves of rw-rw-rw-.
mode_t NewFileMode() {
  static const mode_t mask = [] {
    const mode_t old = umask(077);
    umask(old);
    return old;
  }();
  return 0666 & ~mask;
}

const char* KindOf(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "a device";
  return "no regular file";
}

/// Whether the system lacks what another place or time may have, rather than the name being wrong.
bool LacksRoom(int error) {
  return error == ENOSPC || error == EDQUOT || error == EMFILE || error == ENFILE || error == EIO;
}

void WriteAll(int file, std::string_view bytes, const std::string& name) {
  // the system may take a part at a time, and a signal may come between
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) FailOutput(name, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// Standard output gets the bytes of a file, after what was printed before.
void CopyToStandardOutput(const fs::path& from) {
  if (std::fflush(stdout) != 0) FailOutput("standard output", errno);
  const int file = open(from.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) FailOutput("standard output", errno);
  std::array<char, 65536> block;
  // the file is closed whatever becomes of standard output
  try {
    for (ssize_t n; (n = read(file, block.data(), block.size())) != 0;) {
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) FailOutput("standard output", errno);
      WriteAll(STDOUT_FILENO, {block.data(), static_cast<std::size_t>(n)}, "standard output");
    }
  } catch (...) {
    close(file);
    throw;
  }
  close(file);
}

void SyncFolder(const fs::path& folder) {
  const int file = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  fsync(file);  // not every file system can; the file itself is safe
  close(file);
}

}  // namespace

bool IsStandardOutput(const fs::path& target) { return target == "-" || target == "/dev/stdout"; }

bool IsUnderConstruction(const fs::path& path) {
  constexpr std::string_view begin = ".warmjoint.part.", drawn = "XXXXXX";
  const std::string name = path.filename();
  return name.starts_with(begin) && name.size() >= begin.size() + drawn.size();
}

AtomicFile::AtomicFile(const fs::path& target) : name_(target.string()) {
  if (target.empty()) Refuse({"output"}, "its name is empty; give the name of a file");
  if (IsStandardOutput(target)) {
    // beside the user, so that relative names in it are right; elsewhere where that cannot be
    const fs::path here = access(".", W_OK) == 0 ? fs::path(".") : fs::temp_directory_path();
    MakeTemporary(here);
  } else {
    TakeOver(target);
  }
}

void AtomicFile::TakeOver(const fs::path& target) {
  const fs::path named = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(named)) {
    Refuse({name_}, "its folder '{}' does not exist; create it first", named.string());
  }

  // what is there already, through links as the kernel allows them
  struct stat old {};
  const bool exists = stat(target.c_str(), &old) == 0;
  if (!exists && errno != ENOENT) Refuse({name_}, "cannot be written: {}", Words(errno));
  if (!exists && fs::is_symlink(fs::symlink_status(target))) {
    Refuse({name_}, "is a link to '{}', which does not exist; name the file itself",
           fs::read_symlink(target).string());
  }
  if (exists && !S_ISREG(old.st_mode)) {
    Refuse({name_}, "is {}; outputs go to regular files and new names, or to - (standard output)",
           KindOf(old.st_mode));
  }
  target_ = exists ? fs::canonical(target) : target;

  // beside the target, so that it can take its name in one step
  MakeTemporary(exists ? target_.parent_path() : named);
  if (!exists) {
    fchmod(file_, NewFileMode());
    return;
  }
  // only root may give files away; for others the owner is right already or cannot be kept
  const bool kept = fchown(file_, old.st_uid, old.st_gid) == 0;
  fchmod(file_, old.st_mode & (kept ? 07777 : 0777));
}

void AtomicFile::MakeTemporary(const fs::path& folder) {
  // a drawn name with the extension that the file is to have
  const std::string extension = target_.extension().string();
  std::string pattern = folder / (".warmjoint.part.XXXXXX" + extension);
  file_ = mkostemps(pattern.data(), static_cast<int>(extension.size()), O_CLOEXEC);
  if (file_ >= 0) {
    temporary_ = pattern;
    return;
  }
  // a full disk says nothing against the name
  if (LacksRoom(errno)) FailOutput(name_, errno);
  Refuse({name_}, "its folder '{}' cannot be written to ({}); choose another", folder.string(),
         Words(errno));
}

AtomicFile::~AtomicFile() {
  if (file_ >= 0) close(file_);
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void AtomicFile::Write(std::string_view bytes) { WriteAll(file_, bytes, name_); }

void AtomicFile::Commit() {
  if (target_.empty()) return CopyToStandardOutput(temporary_);
  // on the disk before it gets its name, so that no one finds half a file under it
  if (fsync(file_) != 0) FailOutput(name_, errno);
  const int closed = close(std::exchange(file_, -1));
  if (closed != 0) FailOutput(name_, errno);
  if (rename(temporary_.c_str(), target_.c_str()) != 0) FailOutput(name_, errno);
  temporary_.clear();
  // the name, too, survives a loss of power
  SyncFolder(target_.has_parent_path() ? target_.parent_path() : fs::path("."));
}

void WriteWholeFile(const fs::path& target, std::string_view text) {
  AtomicFile file(target);
  file.Write(text);
  file.Commit();
}

}  // namespace warmjoint::inline models

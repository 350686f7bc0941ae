#include "models/foundation/atomic_file.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <random>
#include <system_error>

#include "models/foundation/bad_input.h"

namespace warmjoint {
namespace fs = std::filesystem;
namespace {

constexpr const char* kOwnFiles = "/proc/self/fd/";  // an open file by its number
constexpr std::string_view kPart = ".warmjoint.part.", kDrawn = "XXXXXX";

/// The name of something under construction, for mkstemp and mkdtemp to draw.
std::string Pattern(const fs::path& folder) {
  return folder / (std::string(kPart) + std::string(kDrawn));
}

/// What is under construction cannot be made in a folder. A full disk says nothing against the name.
[[noreturn]] void RefuseFolder(const std::string& name, const fs::path& folder, int error) {
  if (error == ENOSPC || error == EDQUOT || error == EMFILE || error == ENFILE || error == EIO) {
    FailOutput(name, error);
  }
  Refuse({name}, "its folder '{}' cannot be written to ({}); choose another, or make it first",
         folder.string(), std::generic_category().message(error));
}

/// The permissions in `wanted` that the user's mask leaves to new files.
mode_t Permitted(mode_t wanted) {
  const mode_t mask = umask(077);
  umask(mask);
  return wanted & ~mask;
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

/// Writes all that an open file holds.
void CopyTo(int to, int from, const std::string& name) {
  std::array<char, 65536> block{};
  for (off_t at = 0;;) {
    const ssize_t n = pread(from, block.data(), block.size(), at);
    if (n < 0) FailOutput(name, errno);
    if (n == 0) return;
    WriteAll(to, {block.data(), static_cast<std::size_t>(n)}, name);
    at += n;
  }
}

/// A name of something under construction that nobody can foresee.
fs::path Drawn(const fs::path& folder) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device random;
  std::string name(kPart);
  for (std::size_t i = 0; i < 2 * kDrawn.size(); ++i) name += letters[random() % letters.size()];
  return folder / name;
}

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

/// An open file, closed at the end of its life.
class InputFile {
 public:
  explicit InputFile(const fs::path& path)
      : file_(IsStandardInput(path) ? fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0)
                                    : open(path.c_str(), O_RDONLY | O_NOCTTY | O_CLOEXEC)) {}
  ~InputFile() {
    if (file_ >= 0) close(file_);
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  int get() const { return file_; }

 private:
  int file_;
};

}  // namespace

bool IsStandardOutput(const fs::path& target) { return target == "-" || target == "/dev/stdout"; }

bool IsUnderConstruction(const fs::path& path) {
  const std::string name = path.filename();
  return name.starts_with(kPart) && name.size() >= kPart.size() + kDrawn.size();
}

AtomicFile::AtomicFile(const fs::path& target) : name_(target.string()) {
  if (target.empty()) Refuse({"output"}, "its name is empty; give the name of a file");
  // for standard output beside the user, so that relative names in the file are right
  fs::path folder = access(".", W_OK) == 0 ? fs::path(".") : fs::temp_directory_path();
  struct stat old {};
  bool exists = false;
  if (!IsStandardOutput(target)) {
    std::error_code error;
    target_ = fs::weakly_canonical(fs::absolute(target), error);
    if (error) Refuse({name_}, "cannot be written: {}", error.message());
    exists = stat(target_.c_str(), &old) == 0;
    if (exists && !S_ISREG(old.st_mode)) {
      Refuse({name_}, "is no regular file; give one, a new name, or - for standard output");
    }
    folder = target_.parent_path();
  }

  // in the target's folder, so that it can take its name in one step
  file_ = access(kOwnFiles, X_OK) == 0 ? open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600)
                                       : -1;
  if (file_ < 0) {
    std::string pattern = Pattern(folder);
    file_ = mkostemp(pattern.data(), O_CLOEXEC);
    if (file_ < 0) RefuseFolder(name_, folder, errno);
    temporary_ = pattern;
  }
  fchmod(file_, exists ? old.st_mode & 07777 : Permitted(0666));
}

AtomicFile::~AtomicFile() {
  if (file_ >= 0) close(file_);
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void AtomicFile::Write(std::string_view bytes) { WriteAll(file_, bytes, name_); }

void AtomicFile::Commit() {
  if (target_.empty()) {
    // after what was printed before
    if (std::fflush(stdout) != 0) FailOutput("standard output", errno);
    return CopyTo(STDOUT_FILENO, file_, "standard output");
  }
  // on the disk before it gets its name, so that no one finds half a file under it
  if (fsync(file_) != 0) FailOutput(name_, errno);
  if (temporary_.empty()) {
    // a new file gets its name at once, an older one is replaced by a drawn name
    const std::string own = kOwnFiles + std::to_string(file_);
    const auto link = [&](const fs::path& to) {
      return linkat(AT_FDCWD, own.c_str(), AT_FDCWD, to.c_str(), AT_SYMLINK_FOLLOW) == 0;
    };
    if (link(target_)) return;
    if (errno != EEXIST) FailOutput(name_, errno);
    temporary_ = Drawn(target_.parent_path());
    if (!link(temporary_)) FailOutput(name_, errno);
  }
  if (rename(temporary_.c_str(), target_.c_str()) != 0) FailOutput(name_, errno);
  temporary_.clear();
}

AtomicDirectory::AtomicDirectory(const fs::path& target,
                                 const std::vector<std::string>& replaceable) {
  if (target.empty()) Refuse({"output"}, "its name is empty; give the name of a directory");
  if (target == "-") Refuse({"-"}, "several files do not fit standard output; give a directory");
  target_ = fs::absolute(target).lexically_normal();
  // "out/" names the directory out
  if (!target_.has_filename()) target_ = target_.parent_path();
  if (fs::is_directory(target_)) target_ = fs::canonical(target_);
  RefuseForeignContents(target_, replaceable);

  std::string pattern = Pattern(target_.parent_path());
  if (!mkdtemp(pattern.data())) RefuseFolder(target_.string(), target_.parent_path(), errno);
  temporary_ = pattern;
}

AtomicDirectory::~AtomicDirectory() {
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

void AtomicDirectory::Commit() {
  // mkdtemp lets the user alone in; the finished directory is as open as any that he makes
  struct stat old {};
  const bool exists = stat(target_.c_str(), &old) == 0;
  const mode_t mode = exists ? old.st_mode & 07777 : Permitted(0777);

  // an older directory changes places with the new one in one step; the destructor removes it
  const unsigned flags = exists ? RENAME_EXCHANGE : 0;
  if (chmod(temporary_.c_str(), mode) != 0 ||
      renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), flags) != 0) {
    FailOutput(target_.string(), errno);
  }
}

void WriteWholeFile(const fs::path& target, std::string_view text) {
  AtomicFile file(target);
  file.Write(text);
  file.Commit();
}

bool IsStandardInput(const fs::path& path) { return path == "-"; }

std::string InputName(const fs::path& path) {
  return IsStandardInput(path) ? "standard input" : path.string();
}

std::string ReadWholeFile(const fs::path& path, std::size_t most) {
  if (path.empty()) Refuse({"input"}, "the name of a file is empty; give one");
  const Place place{InputName(path)};
  const InputFile file(path);
  const auto refuse = [&] {
    Refuse(place, "cannot be read ({}); does it exist?", std::generic_category().message(errno));
  };
  struct stat status {};
  if (file.get() < 0 || fstat(file.get(), &status) != 0) refuse();
  if (!S_ISREG(status.st_mode) && !S_ISFIFO(status.st_mode) && !S_ISSOCK(status.st_mode)) {
    Refuse(place, "is {}; give a file, or send one through a pipe",
           S_ISDIR(status.st_mode) ? "a folder"
           : isatty(file.get())    ? "a terminal"
                                   : "a device");
  }

  // pipes tell no size, and files may grow: there is always room for one byte more
  std::string text(std::min(static_cast<std::size_t>(status.st_size), most) + 1, '\0');
  std::size_t filled = 0;
  for (;;) {
    if (filled == text.size()) text.resize(filled + filled / 2 + 4096);
    const ssize_t n = read(file.get(), text.data() + filled, text.size() - filled);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) refuse();
    if (n == 0) break;
    filled += static_cast<std::size_t>(n);
    if (filled <= most) continue;
    Refuse(place, "has more than the {} MiB that are read at most; cut it", most >> 20);
  }
  text.resize(filled);
  return text;
}

}  // namespace warmjoint

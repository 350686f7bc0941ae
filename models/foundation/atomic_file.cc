#include "models/foundation/atomic_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "models/foundation/bad_input.h"

namespace warmjoint::inline models {
namespace fs = std::filesystem;

AtomicFile::AtomicFile(fs::path target) : target_(std::move(target)) {
  const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
  if (!fs::is_directory(folder)) {
    Refuse({target_.string()}, "its folder '{}' does not exist; create it first", folder.string());
  }
  if (access(folder.c_str(), W_OK) != 0) {
    Refuse({target_.string()}, "its folder '{}' cannot be written to; choose another",
           folder.string());
  }

  // the process number keeps two writers of one target apart
  temporary_ = folder / fmt::format(".{}.{}.part{}", target_.stem().string(), getpid(),
                                    target_.extension().string());
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void AtomicFile::Commit() {
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) Refuse({target_.string()}, "cannot be written: {}", error.message());
}

void WriteWholeFile(const fs::path& target, std::string_view text) {
  AtomicFile file(target);
  {
    std::ofstream stream(file.temporary(), std::ios::binary);
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
    stream.close();
    if (!stream) Refuse({target.string()}, "cannot be written; is the disk full?");
  }
  file.Commit();
}

std::string ReadWholeFile(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream || fs::is_directory(path)) Refuse({path.string()}, "cannot be read; does it exist?");
  std::ostringstream text;
  text << stream.rdbuf();
  return std::move(text).str();
}

}  // namespace warmjoint::inline models

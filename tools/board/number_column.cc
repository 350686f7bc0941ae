#include "tools/board/number_column.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include "models/foundation/output_failed.h"

namespace warmjoint::inline tools {
namespace {

constexpr std::size_t kBytes = sizeof(NumberBlock);

off_t OffsetOf(std::uint32_t block) { return static_cast<off_t>(block) * off_t{kBytes}; }

std::filesystem::path Folder() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error) FailOutput("the folder of temporary files (TMPDIR)", error.value());
  return folder;
}

/// A new file that has no name any more.
std::FILE* OpenNameless() {
  // unlinked at once, so that no end of the process leaves it behind
  const std::filesystem::path folder = Folder();
  std::string name = folder / "warmjoint-numbers-XXXXXX";
  const int descriptor = mkostemp(name.data(), O_CLOEXEC);
  if (descriptor < 0) FailOutput(folder, errno);
  unlink(name.c_str());
  return fdopen(descriptor, "w+b");
}

}  // namespace

std::uint32_t NumberFile::Write(const NumberBlock& block) {
  if (!file_) file_.reset(OpenNameless());
  const ssize_t written = pwrite(fileno(file_.get()), block.data(), kBytes, OffsetOf(blocks_));
  if (written != ssize_t{kBytes}) {
    FailOutput(Folder(), written < 0 ? errno : ENOSPC);
  }
  return blocks_++;
}

void NumberFile::Read(std::uint32_t position, NumberBlock& block) const {
  const ssize_t got = pread(fileno(file_.get()), block.data(), kBytes, OffsetOf(position));
  if (got != ssize_t{kBytes}) {
    FailOutput(Folder(), got < 0 ? errno : EIO);
  }
}

NumberColumn::NumberColumn(std::shared_ptr<NumberFile> file) : file_(std::move(file)) {}

void NumberColumn::Add(double value) {
  // a full block goes to the file, the rest stays here
  tail_.push_back(value);
  if (tail_.size() < std::tuple_size_v<NumberBlock>) return;
  NumberBlock block;
  std::copy(tail_.begin(), tail_.end(), block.begin());
  blocks_.push_back(file_->Write(block));
  tail_.clear();
}

void NumberColumn::Add(const NumberColumn& other) {
  other.ForEach([&](double value) { Add(value); });
}

std::span<const double> NumberColumn::Part(std::size_t i, NumberBlock& buffer) const {
  if (i == blocks_.size()) return tail_;
  file_->Read(blocks_[i], buffer);
  return buffer;
}

}  // namespace warmjoint::inline tools

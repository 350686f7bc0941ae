// What the fuzz targets share. Each target is one file in target/ that defines Read; with Clang and
// -DWARMJOINT_FUZZ=ON it becomes a libFuzzer program, else drive.cc runs it over its corpus and mutations of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

/// Calls the target's Read. BadInput is an answer too, where it says something, and in a sentence rather than a book.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace warmjoint::fuzz {

/// Reads bytes that may be anything: they are refused with BadInput, or give what keeps its promises. Anything else
/// ends the process.
void Read(std::string_view bytes);

/// Ends the process where a promise is broken.
void Require(bool holds);

/// A folder for scratch files, in memory where there is one.
std::filesystem::path ScratchFolder();

/// A file that holds the bytes, in ScratchFolder; removed at the end of its life.
class ScratchFile {
 public:
  explicit ScratchFile(std::string_view bytes, std::string_view extension = "");
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Takes one line off the front, without its end.
std::string_view TakeLine(std::string_view& rest);

}  // namespace warmjoint::fuzz

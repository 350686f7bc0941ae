#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <unistd.h>

#include <cstdlib>
#include <system_error>

#include "models/foundation/bad_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace warmjoint;
  constexpr std::size_t longest = 20'000;  // bytes; lists of known names are the longest there are
  try {
    fuzz::Read({reinterpret_cast<const char*>(data), size});
  } catch (const BadInput& refusal) {
    const std::string_view sentence = refusal.what();
    fuzz::Require(!sentence.empty() && sentence.size() < longest);
  }
  return 0;
}

namespace warmjoint::fuzz {
namespace fs = std::filesystem;

void Require(bool holds) {
  if (!holds) std::abort();
}

fs::path ScratchFolder() {
  return access("/dev/shm", W_OK) == 0 ? fs::path("/dev/shm") : fs::temp_directory_path();
}

ScratchFile::ScratchFile(std::string_view bytes, std::string_view extension) {
  std::string name = ScratchFolder() / "warmjoint_fuzz_XXXXXX";
  name += extension;
  const int file = mkstemps(name.data(), static_cast<int>(extension.size()));
  Require(file >= 0);
  path_ = name;
  while (!bytes.empty()) {
    const ssize_t n = write(file, bytes.data(), bytes.size());
    Require(n > 0);
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  close(file);
}

ScratchFile::~ScratchFile() {
  std::error_code ignored;
  fs::remove(path_, ignored);
}

std::string_view TakeLine(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  return line;
}

}  // namespace warmjoint::fuzz

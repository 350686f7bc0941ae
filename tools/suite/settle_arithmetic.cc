#include <unistd.h>

#include <cstdlib>
#include <vector>

#include "models/foundation/atomic_file.h"
#include "tools/suite/arithmetic.h"

namespace warmjoint::inline tools {
namespace {

constexpr const char* kVariable = "GLIBC_TUNABLES";
constexpr const char* kFeatures = "glibc.cpu.hwcaps=";
// the names of glibc 2.33 and later, and of those before; unknown ones are passed over
constexpr const char* kMask = "-FMA,-FMA4,-FMA_Usable,-FMA4_Usable";

}  // namespace

std::string SettledTunables(const std::string& tunables) {
  // what comes last holds
  const std::size_t features = tunables.find(kFeatures);
  if (features != std::string::npos) {
    std::string merged = tunables;
    const std::size_t end = std::min(tunables.find(':', features), tunables.size());
    return merged.insert(end, std::string(",") + kMask);
  }
  return (tunables.empty() ? "" : tunables + ":") + kFeatures + kMask;
}

void SettleArithmetic() {
#if defined(__GLIBC__) && defined(__x86_64__)
  const char* given = std::getenv(kVariable);
  const std::string tunables = given ? given : "";
  if (tunables.find(kMask) != std::string::npos) return;
  setenv(kVariable, SettledTunables(tunables).c_str(), 1);

  // the same arguments once more; where there is no /proc, the digest tells what is different
  std::string words;
  try {
    words = ReadWholeFile("/proc/self/cmdline");
  } catch (const std::exception&) {
    return;
  }
  // the program takes its own place, now with the settled arithmetic
  std::vector<char*> argv;
  for (std::size_t at = 0; at < words.size(); at = words.find('\0', at) + 1) {
    argv.push_back(&words[at]);
  }
  argv.push_back(nullptr);
  execv("/proc/self/exe", argv.data());
#endif
}

}  // namespace warmjoint::inline tools

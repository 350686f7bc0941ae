#include "tools/suite/arithmetic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include "models/foundation/atomic_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/cli/table_one_yaml.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

TEST(Arithmetic, MasksAreAddedToWhatIsThere) {
  const std::string mask = "-FMA,-FMA4,-FMA_Usable,-FMA4_Usable";
  EXPECT_EQ(SettledTunables(""), "glibc.cpu.hwcaps=" + mask);
  EXPECT_EQ(SettledTunables("glibc.malloc.check=1"),
            "glibc.malloc.check=1:glibc.cpu.hwcaps=" + mask);
  EXPECT_EQ(SettledTunables("glibc.cpu.hwcaps=-AVX2:glibc.malloc.check=1"),
            "glibc.cpu.hwcaps=-AVX2," + mask + ":glibc.malloc.check=1");
}

TEST(Arithmetic, ARunHasTheSameBytesOnACpuWithoutFusedMultiplyAdds) {
  const ScratchDirectory scratch;
  const std::string suite = scratch.path() / "little.yaml";
  WriteWholeFile(suite, TableOneSuite(4, "  - {name: energy-ml}\n  - {name: energy-als}\n"));
  std::vector<std::string> bytes;
  for (const char* tunables : {"", "glibc.cpu.hwcaps=-FMA", "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX"}) {
    setenv("GLIBC_TUNABLES", tunables, 1);
    const std::string run = scratch.path() / std::to_string(bytes.size());
    EXPECT_EQ(RunWarmjoint({"run", suite, "-o", run}).status, 0);
    bytes.push_back(ReadWholeFile(run + "/results.sqlite"));
  }
  unsetenv("GLIBC_TUNABLES");
  EXPECT_EQ(bytes[1], bytes[0]);
  EXPECT_EQ(bytes[2], bytes[0]);
}

}  // namespace
}  // namespace warmjoint

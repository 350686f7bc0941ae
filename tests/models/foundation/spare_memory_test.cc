#include "models/foundation/spare_memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

namespace warmjoint {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(SpareMemory, IsSomeAndLessThanAnyMachineHas) {
  EXPECT_GT(SpareMemory(), std::uint64_t{16} << 20);
  EXPECT_LT(SpareMemory(), std::uint64_t{1} << 60);
}

/// Addresses that this process has mapped, bytes.
rlim_t MappedAddresses() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

TEST(SpareMemory, KeepsTheLimitOnAddresses) {
  // far more than the process has, so that nothing else fails
  constexpr rlim_t limit = rlim_t{40} << 30;
  if (MappedAddresses() > limit) GTEST_SKIP() << "a sanitizer has mapped more than the limit";
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  const rlimit less{limit, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_AS, &less), 0);
  EXPECT_LT(SpareMemory(), limit);
  setrlimit(RLIMIT_AS, &before);
}

TEST(RequireMemory, NamesAmountTaskAndRemedy) {
  EXPECT_THAT(
      [] {
        RequireMemory(3e18, "9 samples (duration)", "shorten duration", {"s.yaml", 2});
      },
      ThrowsMessage<BadInput>(
          AllOf(HasSubstr("s.yaml:2: 9 samples (duration) take about 2.66e+03 PiB"),
                HasSubstr("are free; shorten duration"))));
  EXPECT_NO_THROW(RequireMemory(1e6, "a little", "", {}));
}

TEST(MemoryInWords, TakesTheUnitThatFits) {
  EXPECT_EQ(MemoryInWords(0.5 * (1 << 20)), "0.5 MiB");
  EXPECT_EQ(MemoryInWords(3.0 * (1 << 30)), "3 GiB");
  EXPECT_EQ(MemoryInWords(1536.0 * (1ULL << 40)), "1.5 PiB");
}

}  // namespace
}  // namespace warmjoint

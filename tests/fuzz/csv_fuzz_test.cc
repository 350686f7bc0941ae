#include "tests/fuzz/csv_fuzz.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "models/foundation/atomic_file.h"
#include "models/foundation/random_stream.h"
#include "tests/support/folders.h"

namespace warmjoint {
namespace {

std::vector<std::string> Seeds() {
  std::vector<std::string> seeds;
  for (const auto& entry :
       std::filesystem::directory_iterator(test::SourceFolder() / "tests/fuzz/corpus/csv")) {
    seeds.push_back(ReadWholeFile(entry.path()));
  }
  return seeds;
}

void Feed(const std::string& bytes) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

/// One change: a byte, a deletion, a repetition, or a token that readers trip over.
std::string Mutated(std::string bytes, RandomStream& random) {
  static const std::vector<std::string> tokens{
      "nan", "-inf", "1e308", "1e-320", "\"", "\r\n", ",,", ";", "\t", "#", "-", "\xEF\xBB\xBF"};
  const std::size_t at = random.Below(bytes.size() + 1);
  const std::size_t length = random.Below(20);
  switch (random.Below(4)) {
    case 0:
      if (at < bytes.size()) bytes[at] = static_cast<char>(random.Below(256));
      return bytes;
    case 1:
      return bytes.erase(at, length);
    case 2:
      return bytes.insert(at, bytes.substr(at, length));
    default:
      return bytes.insert(at, tokens[random.Below(tokens.size())]);
  }
}

TEST(CsvFuzz, SurvivesItsSeeds) {
  EXPECT_GE(Seeds().size(), 5U);
  for (const std::string& seed : Seeds()) Feed(seed);
}

TEST(CsvFuzz, SurvivesMutations) {
  RandomStream random({11, 0}, Stream::test);
  for (const std::string& seed : Seeds()) {
    for (int i = 0; i < 2000; ++i) {
      std::string bytes = seed;
      for (std::uint64_t changes = 1 + random.Below(4); changes > 0; --changes) {
        bytes = Mutated(std::move(bytes), random);
      }
      Feed(bytes);
    }
  }
}

}  // namespace
}  // namespace warmjoint

#include "tests/support/folders.h"

#include <cstdlib>

namespace warmjoint::test {

std::filesystem::path SourceFolder() { return WARMJOINT_SOURCE_DIR; }

std::filesystem::path BuildFolder() { return WARMJOINT_BINARY_DIR; }

std::filesystem::path SharedFolder() {
  const char* named = std::getenv("WARMJOINT_SHARED");
  return named ? named : WARMJOINT_SHARED_DEFAULT;
}

}  // namespace warmjoint::test

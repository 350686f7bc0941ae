// The golden numbers, and skipping without them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/folders.h"

namespace warmjoint::test {

/// The golden numbers; null where the folder is absent.
inline const nlohmann::json& Golden() {
  static const nlohmann::json golden = [] {
    std::ifstream stream(SharedFolder() / "golden" / "golden.json");
    return stream ? nlohmann::json::parse(stream) : nlohmann::json();
  }();
  return golden;
}

}  // namespace warmjoint::test

/// Skips the running test, with the reason, where a file of the shared folder is absent.
#define WARMJOINT_NEED_SHARED(path)                                       \
  if (!std::filesystem::exists(warmjoint::test::SharedFolder() / (path))) \
  GTEST_SKIP() << (warmjoint::test::SharedFolder() / (path)) << " is absent; set WARMJOINT_SHARED"

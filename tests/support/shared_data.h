// Where the tests find the real recordings, robots and golden numbers that are not part of the
// project.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace warmjoint::test {

/// The folder named by the environment variable WARMJOINT_SHARED, else the one set at
/// configuration.
inline std::filesystem::path SharedFolder() {
  const char* named = std::getenv("WARMJOINT_SHARED");
  return named ? named : WARMJOINT_SHARED_DEFAULT;
}

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

// Skipping tests of real recordings and robots where those are absent.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/folders.h"
#include "tests/support/golden.h"

/// Skips the running test, with the reason, where a file of the shared folder is absent.
#define WARMJOINT_NEED_SHARED(path)                                       \
  if (!std::filesystem::exists(warmjoint::test::SharedFolder() / (path))) \
  GTEST_SKIP() << (warmjoint::test::SharedFolder() / (path)) << " is absent; set WARMJOINT_SHARED"

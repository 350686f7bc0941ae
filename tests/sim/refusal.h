// What a call refuses, and whether that names place, key and value.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint::test {

/// The message of what a call refuses; empty where it does not.
template <typename Call>
std::string RefusalOf(const Call& call) {
  try {
    call();
  } catch (const BadInput& refused) {
    return refused.what();
  }
  return "";
}

/// Expects a text with each of these in it.
inline void ExpectNamed(const std::string& text, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    EXPECT_NE(text.find(name), std::string::npos) << name << " is not in: " << text;
  }
}

}  // namespace warmjoint::test

// Refusals of bad input, held to their place and to what they name, whatever their words.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint::test {

/// What is refused, where, and the key or value that the refusal must name.
struct Refused {
  std::string input;
  std::string place;
  std::string key;
};

/// The words of the BadInput that `make` throws; "accepted" where it throws none.
template <typename Make>
std::string RefusalOf(Make&& make) {
  try {
    make();
  } catch (const BadInput& refusal) {
    return refusal.what();
  }
  return "accepted";
}

/// Expects a text with each of these in it.
inline void ExpectNamed(const std::string& text, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    EXPECT_NE(text.find(name), std::string::npos) << name << " is not in: " << text;
  }
}

/// Expects that a refusal begins with its place and names the key.
inline void ExpectNames(const std::string& refusal, const std::string& place,
                        const std::string& key) {
  EXPECT_TRUE(refusal.starts_with(place)) << refusal << "\nis not about " << place;
  EXPECT_NE(refusal.find(key), std::string::npos) << refusal << "\ndoes not name " << key;
}

/// Expects that `read` refuses the input of each row.
template <typename Read>
void ExpectRefused(const std::vector<Refused>& rows, Read&& read) {
  for (const Refused& one : rows) {
    SCOPED_TRACE(one.input);
    ExpectNames(RefusalOf([&] { read(one.input); }), one.place, one.key);
  }
}

}  // namespace warmjoint::test

// Answers of identifiers with their verdicts, over many recordings.
#pragma once

#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>
#include <warmjoint/recording.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "identification/answer/identify.h"
#include "identification/identifiers/identifier_list.h"
#include "tests/support/warm_recording.h"

namespace warmjoint::test {

inline constexpr int kRealizations = 200;
// of 200: the aim is 95 % power; the error level is 1 %, of which more than 8 come once in 4000 times
inline constexpr int kNearlyAll = 190, kFew = 8;

inline constexpr Status kInadequate = Status::inadequate_model;

/// Table I without warming.
inline Friction Cold() {
  Friction friction = TableOne();
  friction.thermal.reset();
  return friction;
}

/// Along speeds held for 20 s, an hour at 1 Hz. noise: N.m
inline Measurements RecordHour(const Friction& friction, std::uint64_t seed, double noise = 0.5) {
  return RecordFriction(friction, 1, AlternatingSpeeds(3600, seed), noise, seed);
}

/// An identifier's answer with its verdict. given: options by name
inline Estimate Answer(const std::string& name, const PreparedLog& log,
                       const std::map<std::string, std::string>& given = {}) {
  const Identifier& identifier = FindIdentifier(name);
  return IdentifyAndCheck(identifier, {log, identifier.options.Read(given), {}});
}

inline Estimate Answer(const std::string& name, const Measurements& measurements,
                       const std::map<std::string, std::string>& given = {}) {
  return Answer(name, Prepare(measurements), given);
}

/// The same without its verdict.
inline Estimate Fitted(const std::string& name, const PreparedLog& log,
                       const std::map<std::string, std::string>& given = {}, StartKey key = {}) {
  const Identifier& identifier = FindIdentifier(name);
  return IdentifyUnchecked(identifier, {log, identifier.options.Read(given), key});
}

inline Estimate Fitted(const std::string& name, const Measurements& measurements,
                       const std::map<std::string, std::string>& given = {}, StartKey key = {}) {
  return Fitted(name, Prepare(measurements), given, key);
}

/// What an estimate of a friction is held against: its law but for the exponent, and its warming.
inline std::map<std::string, double> TruthOf(const Friction& friction) {
  std::map<std::string, double> truth = friction.parameters;
  truth.erase("stribeck_exponent");
  if (!friction.thermal) return truth;
  truth["thermal_gain"] = friction.thermal->gain;
  truth["thermal_time_constant"] = friction.thermal->time_constant;
  return truth;
}

/// Whether the interval of a parameter holds the truth; false where there is none.
inline bool Holds(const Estimate& estimate, const std::string& name, double truth) {
  const EstimatedParameter* found = estimate.Find(name);
  if (!found || !found->interval95) return false;
  const auto [lower, upper] = *found->interval95;
  return lower <= truth && truth <= upper;
}

/// Expects each parameter within so many of its own deviations. most: of a deviation, as a share of the truth.
inline void ExpectTold(const Estimate& estimate, const std::map<std::string, double>& truth,
                       double deviations, double most = kInfinity) {
  for (const auto& [name, value] : truth) {
    const EstimatedParameter* found = estimate.Find(name);
    ASSERT_TRUE(found && found->std) << name << ": " << estimate.FullMessage();
    EXPECT_NEAR(found->value, value, deviations * *found->std) << name;
    EXPECT_LT(*found->std, most * std::abs(value)) << name;
  }
}

/// Expects an answer with each parameter within a share of the truth.
inline void ExpectFound(const Estimate& estimate, const std::map<std::string, double>& truth,
                        double share) {
  ASSERT_EQ(estimate.status, Status::ok) << estimate.FullMessage();
  for (const auto& [name, value] : truth) {
    const EstimatedParameter* found = estimate.Find(name);
    ASSERT_TRUE(found) << name;
    EXPECT_NEAR(found->value, value, share * std::abs(value)) << name;
  }
}

/// Expects that of so many answers, by seeds from 1 on, all are ok and intervals hold each truth so often at least.
inline void ExpectHeld(int realizations, int at_least, const std::map<std::string, double>& truth,
                       const std::function<Estimate(std::uint64_t)>& answer) {
  std::map<std::string, int> held;
  for (int seed = 1; seed <= realizations; ++seed) {
    const Estimate estimate = answer(static_cast<std::uint64_t>(seed));
    EXPECT_EQ(estimate.status, Status::ok) << seed << estimate.message;
    for (const auto& [name, value] : truth) held[name] += Holds(estimate, name, value);
  }
  for (const auto& [name, count] : held) EXPECT_GE(count, at_least) << name;
}

/// The outcome of a test for lack of fit, by its name; one that is not there was not made.
inline Diagnostic Asked(const Estimate& estimate, const std::string& test) {
  for (const Diagnostic& one : estimate.diagnostics) {
    if (one.test == test) return one;
  }
  return {};
}

/// The name of an identifier as that of a test.
inline std::string NameOf(const testing::TestParamInfo<Identifier>& member) {
  std::string name = member.param.name;
  std::erase(name, '-');
  return name;
}

using MakeLog = std::function<Measurements(std::uint64_t)>;

/// In how many realizations the answer is as asked.
inline int CountAnswers(const std::string& name, const MakeLog& make,
                        const std::function<bool(const Estimate&)>& asked) {
  int count = 0;
  for (std::uint64_t seed = 1; seed <= kRealizations; ++seed) {
    count += asked(Answer(name, make(seed)));
  }
  return count;
}

/// How many realizations end with `status`.
inline int Count(const std::string& name, Status status, const MakeLog& make) {
  return CountAnswers(name, make, [&](const Estimate& one) { return one.status == status; });
}

/// In how many realizations a test rejects.
inline int CountRejected(const std::string& name, const std::string& test, const MakeLog& make) {
  return CountAnswers(name, make, [&](const Estimate& one) { return Asked(one, test).rejected; });
}

/// How many realizations have any test that rejects.
inline int CountAlarms(const std::string& name, const MakeLog& make) {
  return CountAnswers(name, make, [](const Estimate& one) {
    return std::ranges::any_of(one.diagnostics, &Diagnostic::rejected);
  });
}

}  // namespace warmjoint::test

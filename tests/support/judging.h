// Answers of identifiers with their verdicts, over many recordings.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "identification/answer/identify.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/preparation/select.h"
#include "tests/support/warm_recording.h"

namespace warmjoint::test {

inline constexpr int kRealizations = 200;
// of 200: the aims are 95 % power and 5 % false alarms
inline constexpr int kNearlyAll = 190, kFew = 10;

inline constexpr Status kInadequate = Status::inadequate_model;

/// Table I without warming.
inline FrictionDescription Cold() {
  FrictionDescription friction = TableOne();
  friction.thermal.reset();
  return friction;
}

/// Along speeds held for 20 s, an hour at 1 Hz. noise: N.m
inline Measurements RecordHour(const FrictionDescription& friction, std::uint64_t seed,
                               double noise = 0.5) {
  return RecordFriction(friction, 1, AlternatingSpeeds(3600, seed), noise, seed);
}

inline Estimate Answer(const std::string& name, const Measurements& measurements,
                       const std::map<std::string, std::string>& given = {}) {
  const Identifier& identifier = FindIdentifier(name);
  const Options options(identifier.options, given, {});
  return IdentifyAndJudge(identifier, {Prepare(measurements), options, {}});
}

/// How many realizations end with `status` and say `reason`.
inline int Count(const std::string& name, Status status, const std::string& reason,
                 const std::function<Measurements(std::uint64_t)>& make) {
  int count = 0;
  for (std::uint64_t seed = 1; seed <= kRealizations; ++seed) {
    const Estimate estimate = Answer(name, make(seed));
    if (estimate.status == status && estimate.FullMessage().find(reason) != std::string::npos)
      ++count;
  }
  return count;
}

}  // namespace warmjoint::test

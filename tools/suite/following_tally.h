// Which realizations of a run hold the motion that was asked for.
#pragma once

#include <string>

#include "scenarios/suite.h"
#include "sim/truth/truth.h"
#include "tools/store/result.h"

namespace warmjoint::inline tools {

/// Two sentences on a joint that did not follow its motion: in what share of the time it reached its
/// commanded speed, and the settings that cure it.
std::string NotFollowingInWords(const Following& following);

/// Counts the realizations whose joint did not follow.
class FollowingTally {
 public:
  void Add(Unit unit, const Following& following);

  /// What is to be said of them, with the worst; empty where every joint followed.
  std::string Words(const Suite& suite) const;

 private:
  int realizations_ = 0;
  int astray_ = 0;
  Unit worst_unit_;
  Following worst_;
};

}  // namespace warmjoint::inline tools

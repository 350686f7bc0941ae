// Which realizations of a run hold the motion that was asked for.
#pragma once

#include <warmjoint/simulation.h>

#include <string>

#include "scenarios/suite.h"
#include "tools/store/result.h"

namespace warmjoint {

/// Counts the realizations whose joint did not follow.
class FollowingTally {
 public:
  void Add(RunUnit unit, const Following& following);

  /// What is to be said of them, with the worst; empty where every joint followed.
  std::string Words(const Suite& suite) const;

 private:
  int realizations_ = 0;
  int astray_ = 0;
  RunUnit worst_unit_;
  Following worst_;
};

}  // namespace warmjoint

// A suite for tests of stores and leaderboards, whose identifiers are never run.
#pragma once

#include <string>

#include "tools/store/run_store.h"

namespace warmjoint {

/// The description of a suite little with identifiers a and b, of which b claims an NPE of 0.05, and four
/// realizations. more: further entries, for example a ladder.
inline RunDescription LittleRun(const std::string& more = "") {
  return {
      "name: little\nquestion: Who is best?\nrealizations: 4\nseed: 7\n"
      "scenario:\n"
      "  friction: {law: viscous_coulomb, parameters: {viscous: 5, coulomb: 15}}\n"
      "  motion: {speeds: [1], hold: 2}\n  sampling: {rate: 10}\n  duration: 20\n"
      "identifiers:\n  - {name: nominal-ls, label: a}\n"
      "  - {name: energy-ml, label: b, claim: {source: someone, npe_continuous: 0.05}}\n" +
          more,
      {{"warmjoint", "0.1.0"}}};
}

}  // namespace warmjoint

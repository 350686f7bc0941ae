// Which structure was chosen, of those that were tried.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "models/foundation/field.h"

namespace warmjoint::inline identification {

/// A structure that was tried.
struct StructureTrial {
  std::string name;            // identifier and options: "energy-ml law=coulomb"
  std::optional<double> rmse;  // on held-out blocks, N.m or N; none where it was dropped before
  double parameters = 0;       // effective number; 0 where nothing was fitted
  std::string dropped;         // why it was no contender; empty for one that was

  template <class A>
  void Serialize(A* a) {
    a->Field("name", &name, {.needed = "name it"});
    a->Field("rmse", &rmse, {.unit = "N.m", .at_default = AtDefault::null});
    a->Field("parameters", &parameters);
    a->Field("dropped", &dropped, {.at_default = AtDefault::null});
  }
};

/// Which of several structures was chosen, and why.
struct StructureChoice {
  std::string chosen;
  std::string reason;  // one clause
  int blocks = 0;      // of time that were held out in turn
  std::vector<StructureTrial> trials;

  template <class A>
  void Serialize(A* a) {
    a->Field("chosen", &chosen, {.needed = "name a structure"});
    a->Field("reason", &reason);
    a->Field("blocks", &blocks);
    a->Field("trials", &trials);
  }
};

}  // namespace warmjoint::inline identification

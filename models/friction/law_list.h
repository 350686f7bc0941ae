// The one list of laws, as types: for code that is made anew for each law.
#pragma once

#include "models/friction/bristle_laws.h"
#include "models/friction/steady_laws.h"

namespace warmjoint {

/// What a joint at rest bears before it slides, in N.m or N: the static level of laws that break
/// away, and the level of sliding of all others. side: 1 or -1; speed: rad/s or m/s.
template <typename L, typename T>
T HoldingLevelOf(int side, double speed, const T* p) {
  if constexpr (L::pre_sliding == PreSliding::breakaway) {
    return L::StaticLevel(side, p);
  } else {
    return L::Level(side, speed, p);
  }
}

/// Whether a law says of itself, by level_at_any_speed, that no level of it depends on the speed.
template <typename L>
concept LawAtAnySpeed = requires {
  L::level_at_any_speed;
};

/// Whether a law brings a bristle of its own, by BristleOf, which follows a motion as BristleCourse does.
template <typename L>
concept LawWithBristle = requires(const double* p) {
  L::BristleOf(p);
};

template <typename... L>
struct LawList {
  static_assert(((LawWithBristle<L> == (L::pre_sliding == PreSliding::bristle)) && ...),
                "a law with a bristle of its own needs BristleOf, and no other law has one");
};

/// All laws: a new one is a struct and its name here.
using AllLaws = LawList<Coulomb, ViscousCoulomb, Asymmetric, Stiction, Stribeck, AsymmetricStribeck,
                        Dahl, LuGre, AsymmetricLuGre>;

}  // namespace warmjoint

// The one list of laws, as types: for code that is made anew for each law.
#pragma once

#include "models/friction/asymmetric.h"
#include "models/friction/asymmetric_lugre.h"
#include "models/friction/asymmetric_stribeck.h"
#include "models/friction/coulomb.h"
#include "models/friction/dahl.h"
#include "models/friction/lugre.h"
#include "models/friction/stiction.h"
#include "models/friction/stribeck.h"
#include "models/friction/viscous_coulomb.h"

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

/// Whether a law brings hidden state that follows a motion: a Course<T> as BristleCourse is one,
/// with BeginSliding, BeginBent, Follow, Force, Loss and load.
template <typename L>
concept LawWithCourse = requires {
  typename L::template Course<double>;
};

template <typename... L>
struct LawList {
  static_assert(((LawWithCourse<L> == (L::pre_sliding == PreSliding::bristle)) && ...),
                "a law with a bristle of its own needs a Course, and no other law has one");
};

/// All laws: a new one is its own header and one line here.
using AllLaws = LawList<Coulomb, ViscousCoulomb, Asymmetric, Stiction, Stribeck, AsymmetricStribeck,
                        Dahl, LuGre, AsymmetricLuGre>;

}  // namespace warmjoint

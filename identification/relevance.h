// What lack of fit matters by default.
#pragma once

namespace warmjoint::inline identification {

/// Change of the friction (law and heat, rms) by what a model leaves out from which it is refused, as a share,
/// where nobody says otherwise (`--relevance`).
inline constexpr double kDefaultRelevance = 0.1;

}  // namespace warmjoint::inline identification

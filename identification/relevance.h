// What lack of fit matters by default.
#pragma once

namespace warmjoint::inline identification {

/// Lack of fit from which a model is refused, as a share of the friction's rms, where nobody says
/// otherwise (`--relevance`).
inline constexpr double kDefaultRelevance = 0.02;

}  // namespace warmjoint::inline identification

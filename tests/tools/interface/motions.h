// Recordings that the tests of the public interface identify.
#pragma once

namespace warmjoint {

/// Four speeds in both directions, 30 s each, rad/s; i: s.
inline double SeveralSpeeds(int i) { return (i / 30 % 2 ? -1 : 1) * 0.2 * (1 + i / 60 % 4); }

/// One speed in both directions, rad/s.
inline double OneSpeed(int i) { return i / 20 % 2 ? -0.5 : 0.5; }

}  // namespace warmjoint

// The samples of a recording that show the LuGre law, and the problem of its fit.
#pragma once

#include "identification/fit/identifier.h"
#include "identification/nonlinear/lugre_fit.h"

namespace warmjoint {

/// The problem of a law on a recording, its deviations at `scale` throughout.
///   used      from the first kept sample of each recording to its last one: those kept, and those
///             in between that are not at rest, which are starts, stops and turns
///   bristle   runs over all samples; in rests of five samples and more, whose speed is noise
///             (VelocityScale::Rest), it stays as it is; its bend at each start is estimated
///   a         central differences of the velocity; 0 in segments of constant speed, where they
///             would be only noise
LugreProblem MakeLugreProblem(const IdentifierInput& input, const FallingLaw& law, double scale);

/// Every other sample of each recording, and its problem as if the log held no others.
struct HalvedProblem {
  std::vector<Eigen::Index> samples;  // of the whole recording
  LugreProblem problem;
};

/// The halved problem shows how much the sampling matters; it uses those samples that `problem` uses.
HalvedProblem Halve(const IdentifierInput& input, const LugreProblem& problem);

/// The kept samples of steady sliding, if presliding is over after `distance`, rad or m: four
/// times that from the last turn or rest, at the speed of both neighbours to 5 %. At most
/// 4000, evenly chosen.
Selection SteadySamples(const IdentifierInput& input, double distance);

}  // namespace warmjoint

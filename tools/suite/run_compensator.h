// One compensator on the day of a realization.
#pragma once

#include <warmjoint/prepared_log.h>
#include <warmjoint/simulation.h>

#include <Eigen/Core>
#include <cstdint>

#include "scenarios/scenario.h"
#include "tools/store/run_store.h"
#include "tools/suite/prepare_identifiers.h"

namespace warmjoint {

/// What compensators are run on.
struct CompensationDays {
  /// As a controller has them: the torque is without weight and inertia, the velocity 0 at rest. A sensor reads the temperature of
  /// the joint's housing, K over the cold joint.
  LogSamples today, before;
  const Simulation& recording;  // of today, with the truth
  Friction known;               // as a friction file has it: one stage of heat, no surroundings
  Eigen::VectorXd contact;      // [N] today, N.m or N
};

/// The day of a realization, and the one before of the same joint, which is simulated here and on which nothing leaned on it. log: of
/// the recording. Throws what the plant throws.
CompensationDays MakeDays(const Scenario& scenario, std::uint64_t realization,
                          const Simulation& recording, const PreparedLog& log);

/// Whatever a compensator does wrong becomes the status and message of its result.
Result RunCompensator(const PreparedCompensator& compensate, const CompensationDays& days);

}  // namespace warmjoint

// A compensator along a recording: friction, residual and heat at each sample.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>

#include <filesystem>
#include <optional>
#include <string>

#include "models/friction/compensator.h"
#include "models/recording/assemble.h"
#include "tools/identify/predict_recording.h"

namespace warmjoint {

/// What compensates one joint.
struct JointToCompensate {
  StoredModel stored;
  FrictionDoubt doubt;
  double slowest = 0;  // of the speeds at which the friction was seen, rad/s or m/s; 0: not known
};

/// Of an estimate. file: of it, in messages. Throws BadInput where it holds no friction.
JointToCompensate ToCompensate(const Estimate& estimate, const std::string& file);

/// Of estimate.json, or of a friction file. Throws BadInput.
JointToCompensate ReadToCompensate(const std::string& file);

/// The dead band where none is given: a tenth of the slowest speed at which the friction was seen, rad/s or m/s. why: a
/// noise of the velocity beyond that would have hidden the speed itself.
double DeadBandOf(const JointToCompensate& joint);

/// What is kept of a compensator between two recordings.
struct KeptState {
  double energy = 0;
  double second_energy = 0;
  double correction = 0;
  double variance = 0;
  double time = 0;  // of the last sample

  template <class A>
  void Serialize(A* a) {
    a->Field("energy", &energy, Needed("N.m", "E1"));
    a->Field("second_energy", &second_energy, Needed("N.m", "E2; 0 where there is one stage"));
    a->Field("correction", &correction, Needed("N.m", "of the level"));
    a->Field("variance", &variance, Needed("(N.m)^2", "of the level", kNotNegative));
    a->Field("time", &time, Needed("s", "stamp of the last sample"));
  }
};

/// Goes on with a kept state, after the pause between its stamp and `begin`, s, or the one that is given. Returns the
/// pause. Throws BadInput where the stamps share no clock.
double GoOn(Compensator& compensator, const KeptState& kept, double begin,
            std::optional<double> pause, const std::string& file);

KeptState StateOf(const Compensator& compensator, double time);

struct CompensatedLog {
  LogSamples measurements;
  Eigen::VectorXd
      torque;  // [N] less weight and inertia, N.m or N; NaN where the weight is not known
  Compensated found;
};

/// Along the log as it was taken, from the compensator's heat on. Weight and inertia of the model are taken off the torque. Throws
/// BadInput where the log is in another unit than the friction, or lacks a position that the model needs.
CompensatedLog CompensateLog(const StoredModel& stored, const PreparedLog& log,
                             Compensator& compensator);

/// time, position, velocity, torque, friction, residual, energy, loss, std, contact, compensation: a row for each logged sample, SI.
FileContent ColumnsOf(const CompensatedLog& log);

}  // namespace warmjoint

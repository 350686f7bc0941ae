// A stored estimate on another recording.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/friction_model.h>
#include <warmjoint/prepared_log.h>

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "identification/holdout/hold_out.h"
#include "tools/identify/carried_heat.h"
#include "tools/identify/recording_source.h"

namespace warmjoint {

/// What an estimate file knows of the joint. The log's acceleration is used where it holds an inertia.
struct StoredModel {
  std::string identifier;
  Status status = Status::ok;
  TorqueModel model;
};

/// Of an estimate. file: of it, in messages. Throws BadInput where it holds no friction.
StoredModel StoredModelOf(const Estimate& estimate, const std::string& file);

/// Of estimate.json, or of a friction file. Throws BadInput from `file` where it holds no friction.
StoredModel ReadStoredModel(const std::string& file);

/// How to read a recording that the model is held against: with the model's own gear, and with a torque in amperes where
/// the model's is, as far as nothing else is said.
RecordingSource AsIdentified(const StoredModel& stored, RecordingSource recording);

/// How warm the joint is at the first sample.
struct WarmStart {
  ThermalStart start;
  std::optional<CarriedHeat> follows;  // where an earlier recording says so
};

/// As `initial` says (InitialEnergies), or, where there is an earlier recording, with the heat that it left: of an
/// estimate.json its state_end; of a recording, read as `recording` says, what the model makes of its motion from a
/// cold start. file: of the model. Throws BadInput.
WarmStart StartOf(const StoredModel& stored, const std::string& file, const std::string& initial,
                  const EarlierRecording& earlier, const RecordingSource& recording,
                  const Measurements& next);

/// What the model predicts, and how well.
struct Predicted {
  LogSamples measurements;  // of the log as the model sees it
  TorquePrediction torque;
  Metrics metrics;  // over the samples that take part; its parameters count 0, since none is fitted
};

/// Along the log, whose heat begins with `start`. Throws BadInput where the log is in another unit
/// than friction for MuJoCo is, or no sample is left to compare.
Predicted PredictLog(const StoredModel& stored, const PreparedLog& log, const ThermalStart& start);

/// {identifier, status, metrics{n, rmse, mae, fit}, state_end{energy, second_energy}}
nlohmann::json PredictedToJson(const StoredModel& stored, const Predicted& predicted);

/// time, position, velocity, torque, predicted, residual, energy, compared (1 or 0): a row for each of the log,
/// SI.
std::string PredictedToCsv(const Predicted& predicted);

}  // namespace warmjoint

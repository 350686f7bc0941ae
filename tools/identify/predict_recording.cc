#include "tools/identify/predict_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "identification/estimate.h"
#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/fit/seen_samples.h"
#include "models/foundation/node.h"
#include "models/friction/friction_json.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

/// The samples that a model is compared with: all that move, where it has an inertia.
const LogView& ViewOf(const StoredModel& stored, const PreparedLog& log) {
  return SeenByModel(stored.model.inertia, View::constant_speed, log);
}

/// What a recording leaves, as a model has it that knows no errors.
LeftHeat HeatAtEnd(const StoredModel& stored, const PreparedLog& log, const std::string& file) {
  const auto& [m, selection] = ViewOf(stored, log);
  const Friction& friction = stored.model.friction;
  const FrictionState end = PredictTorque(stored.model, m, selection, {}).friction.end;
  // each stage has its own heat and cools by its own time constant
  LeftHeat left{file, m.time[m.size() - 1], m.torque_unit, {}};
  left.stages.push_back({end.energy, 0, friction.thermal->time_constant, 0});
  if (friction.second_thermal) {
    left.stages.push_back({end.second_energy, 0, friction.second_thermal->time_constant, 0});
  }
  return left;
}

CarriedHeat HeatBefore(const StoredModel& stored, const EarlierRecording& earlier,
                       const RecordingSource& recording, const Measurements& next) {
  const std::string& file = earlier.file;
  if (!stored.model.friction.thermal) {
    Refuse({"--follows"}, "is for a friction that warms, and the estimate knows no warming");
  }
  // an estimate says itself which heat its log left
  if (const auto left = HeatLeftIn(file)) return CarryOver(*left, earlier.pause, next);
  RecordingSource before = recording;
  before.files = {file};
  return CarryOver(HeatAtEnd(stored, ReadAndPrepare(before), file), earlier.pause, next);
}

}  // namespace

StoredModel StoredModelOf(const Estimate& estimate, const std::string& file) {
  // an estimate without friction predicts nothing
  if (!estimate.friction) {
    Refuse({file}, "is {} and holds no friction; identify again{}", StatusName(estimate.status),
           estimate.status == Status::ok ? "" : " with --force to use it anyway");
  }
  return {estimate.identifier,
          estimate.status,
          {*estimate.friction, estimate.gravity, ValueOf(Role::inertia, estimate),
           ValueOf(Role::lag, estimate), ValueOf(Role::delay, estimate)}};
}

StoredModel ReadStoredModel(const std::string& file) {
  const Node document = ReadJsonNode(file);
  if (document.Find("identifier")) return StoredModelOf(EstimateFrom(document), file);
  // a file of friction alone has no verdict
  StoredModel stored;
  stored.identifier = "friction file";
  stored.model.friction = ReadFriction(file);
  return stored;
}

RecordingSource AsIdentified(const StoredModel& stored, RecordingSource recording) {
  const Friction& friction = stored.model.friction;
  if (recording.read.gear == ReadSettings{}.gear) recording.read.gear = friction.gear;
  const ReadSettings& read = recording.read;
  const bool told = read.torque_constant != 0 || read.unit.contains("torque");
  if (!friction.torque_unit.empty() && !told) recording.read.unit["torque"] = friction.torque_unit;
  return recording;
}

WarmStart StartOf(const StoredModel& stored, const std::string& file, const std::string& initial,
                  const EarlierRecording& earlier, const RecordingSource& recording,
                  const Measurements& next) {
  WarmStart begin;
  if (earlier.is_given()) begin.follows = HeatBefore(stored, earlier, recording, next);
  const std::vector<double> energies =
      begin.follows ? begin.follows->energy : InitialEnergies(initial, stored.model.friction, file);
  // E1 and E2; without warming there is none
  if (!energies.empty()) begin.start.energy = energies[0];
  if (energies.size() > 1) begin.start.second_energy = energies[1];
  return begin;
}

Predicted PredictLog(const StoredModel& stored, const PreparedLog& log, const ThermalStart& start) {
  // with an inertia any motion can be compared, else constant speeds only
  const LogView& view = ViewOf(stored, log);
  const LogSamples& m = view.measurements;
  const std::string& amperes = stored.model.friction.torque_unit;
  const std::string_view unit = amperes.empty() ? kTorqueUnit.For(m.joint) : amperes;
  if (m.torque_unit != unit) {
    Refuse({m.source}, "has a torque in {} and friction is in {}; give {}", m.torque_unit, unit,
           amperes.empty() ? "--torque-constant" : "--unit torque=A");
  }
  // gravity and maps need the positions that a velocity alone does not tell
  const auto over_position = [&m](const FrictionMap& map) {
    return FindAxis(map, MapQuantity::position) ||
           (FindAxis(map, MapQuantity::motor_position) && !KnowsMotorAngle(m));
  };
  const bool needs =
      stored.model.gravity || std::ranges::any_of(stored.model.friction.maps, over_position);
  if (m.position_integrated && needs) {
    Refuse({m.source}, "has no positions, and the estimate's gravity or map needs them; log them");
  }
  Predicted predicted{m, PredictTorque(stored.model, m, view.selection, start), {}};
  // samples that all parts of the model know
  const Selection& known = predicted.torque.covered;
  if (known.count() == 0) {
    Refuse({m.source}, "no sample can be compared: {} of {} samples {}{}", view.selection.count(),
           m.size(), stored.model.inertia ? "move clearly" : "move at a constant speed",
           view.selection.count() > 0 ? ", all where the estimate knows no gravity" : "");
  }
  // nothing was fitted to these samples
  predicted.metrics =
      ComputeMetrics(Kept(m.torque, known), Kept(predicted.torque.torque, known), 0, 0);
  return predicted;
}

nlohmann::json PredictedToJson(const StoredModel& stored, const Predicted& predicted) {
  const Metrics& metrics = predicted.metrics;
  nlohmann::json json{
      {"identifier", stored.identifier},
      {"status", StatusName(stored.status)},
      {"metrics",
       {{"n", metrics.n}, {"rmse", metrics.rmse}, {"mae", metrics.mae}, {"fit", metrics.fit}}}};
  // the heat that the recording leaves behind
  const FrictionState& end = predicted.torque.friction.end;
  if (stored.model.friction.thermal) json["state_end"]["energy"] = end.energy;
  if (stored.model.friction.second_thermal) json["state_end"]["second_energy"] = end.second_energy;
  return json;
}

std::string PredictedToCsv(const Predicted& predicted) {
  const LogSamples& m = predicted.measurements;
  const TorquePrediction& torque = predicted.torque;
  std::string csv = "time,position,velocity,torque,predicted,residual,energy,compared\n";
  for (const Eigen::Index i : m.Logged()) {
    csv += fmt::format("{},{},{},{},{},{},{},{:d}\n", m.time[i], m.position[i], m.velocity[i],
                       m.torque[i], torque.torque[i], m.torque[i] - torque.torque[i],
                       torque.friction.energy[i], torque.covered.keep[i]);
  }
  return csv;
}

}  // namespace warmjoint

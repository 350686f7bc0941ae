#include "tools/actions/predict_recording.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "identification/estimate_from_json.h"
#include "identification/find_parameter.h"
#include "identification/fit_data.h"
#include "identification/metrics.h"
#include "identification/preparation/moving_view.h"
#include "models/foundation/read_json.h"
#include "models/friction/friction_json.h"

namespace warmjoint::inline tools {

StoredModel ReadStoredModel(const std::string& file) {
  const nlohmann::json object = ReadJsonFile(file);
  StoredModel stored;
  // a file of friction alone has no verdict
  if (!object.is_object() || !object.contains("identifier")) {
    stored.identifier = "friction file";
    stored.model.friction = ReadFrictionFile(file);
    return stored;
  }
  const Estimate estimate = EstimateFromJson(object, {file});
  // an estimate without friction predicts nothing
  if (!estimate.friction) {
    Refuse({file}, "is {} and holds no friction; identify again{}", StatusName(estimate.status),
           estimate.status == Status::ok ? "" : " with --force to use it anyway");
  }
  stored.identifier = estimate.identifier;
  stored.status = estimate.status;
  stored.model = {*estimate.friction, estimate.gravity, {}};
  // inertia and lag of the torque, where the estimate has them
  if (const EstimatedParameter* inertia = Find(Role::inertia, estimate)) {
    stored.model.inertia = inertia->value;
  }
  if (const EstimatedParameter* lag = Find(Role::lag, estimate)) stored.model.lag = lag->value;
  return stored;
}

RecordingArguments AsIdentified(const StoredModel& stored, RecordingArguments recording) {
  const FrictionDescription& friction = stored.model.friction;
  if (recording.gear == RecordingArguments{}.gear) recording.gear = friction.gear;
  const bool told =
      recording.torque_constant != 0 || ReadPairs(recording.unit, "--unit").contains("torque");
  if (!friction.torque_unit.empty() && !told) {
    recording.unit.push_back("torque=" + friction.torque_unit);
  }
  return recording;
}

Predicted PredictLog(const StoredModel& stored, const PreparedLog& log, const CourseStart& start) {
  // with an inertia any motion can be compared, else constant speeds only
  const LogView& view = stored.model.inertia ? MovingView(log) : log.steady();
  const Measurements& m = view.measurements;
  const std::string& amperes = stored.model.friction.torque_unit;
  const std::string_view unit = amperes.empty() ? kTorqueUnit.For(m.joint) : amperes;
  if (m.torque_unit != unit) {
    Refuse({m.source}, "has a torque in {} and friction is in {}; give {}", m.torque_unit, unit,
           amperes.empty() ? "--torque-constant" : "--unit torque=A");
  }
  Predicted predicted{m, PredictTorque(stored.model, m, view.selection, start), {}, {}};
  // samples put in between those that were logged are no rows of the log
  const Eigen::VectorXd& logged = log.taken().measurements.time;
  for (Eigen::Index i = 0, n = 0; i < m.size() && n < logged.size(); ++i) {
    if (m.time[i] != logged[n]) continue;
    predicted.logged.push_back(i);
    ++n;
  }
  // samples that all parts of the model know
  const Selection& known = predicted.torque.known;
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
  const Measurements& m = predicted.measurements;
  const TorquePrediction& torque = predicted.torque;
  std::string csv = "time,position,velocity,torque,predicted,residual,energy,compared\n";
  for (const Eigen::Index i : predicted.logged) {
    csv += fmt::format("{},{},{},{},{},{},{},{:d}\n", m.time[i], m.position[i], m.velocity[i],
                       m.torque[i], torque.torque[i], m.torque[i] - torque.torque[i],
                       torque.friction.energy[i], torque.known.keep[i]);
  }
  return csv;
}

}  // namespace warmjoint::inline tools

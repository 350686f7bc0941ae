#include "identification/estimate.h"

#include <warmjoint/estimate.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "models/foundation/serialize.h"
#include "tools/actions/identify_recording.h"
#include "tools/interface/convert_estimate.h"
#include "tools/interface/convert_recording.h"
#include "tools/interface/guarded.h"

namespace warmjoint::api {
namespace {

Estimate From(const models::Node& file) {
  Estimate estimate = FromEstimate(identification::EstimateFrom(file));
  // the files that it tells of, where it tells of files, and the heat with which it began
  if (const auto source = tools::RecordingIn(file)) estimate.recording = FromSource(*source);
  if (const auto heat = file.Find("follows")) {
    estimate.follows = FromCarried(models::ReadAs<tools::CarriedHeat>(*heat));
  }
  return estimate;
}

/// target: the file, from whose folder its recordings are named.
std::string TextOf(const Estimate& estimate, const std::filesystem::path& target = {}) {
  std::optional<tools::RecordingSource> source;
  if (estimate.recording) source = ToSource(*estimate.recording);
  std::optional<tools::CarriedHeat> follows;
  if (estimate.follows) follows = ToCarried(*estimate.follows);
  return tools::EstimateFile(ToEstimate(estimate), source, target, follows);
}

}  // namespace

std::string StatusName(Status status) {
  // by way of the rooms, which alone have the names
  Estimate estimate;
  estimate.status = status;
  return std::string(identification::StatusName(ToEstimate(estimate).status));
}

const Parameter* Estimate::Find(const std::string& name) const {
  const auto found = std::ranges::find(parameters, name, &Parameter::name);
  return found == parameters.end() ? nullptr : &*found;
}

std::string EstimateToJson(const Estimate& estimate) {
  return Guarded([&] { return TextOf(estimate); });
}

Estimate EstimateFromJson(const std::string& text, const std::string& name) {
  return Guarded([&] { return From(models::ParseJsonNode(text, name)); });
}

Estimate ReadEstimate(const std::filesystem::path& file) {
  return Guarded([&] { return From(models::ReadJsonNode(file)); });
}

void WriteEstimate(const Estimate& estimate, const std::filesystem::path& file) {
  Guarded([&] { models::WriteWholeFile(file, TextOf(estimate, file)); });
}

}  // namespace warmjoint::api

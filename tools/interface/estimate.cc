#include <warmjoint/estimate.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "identification/estimate_from_json.h"
#include "identification/estimate_to_json.h"
#include "models/foundation/atomic_file.h"
#include "models/foundation/read_json.h"
#include "tools/actions/identify_recording.h"
#include "tools/interface/convert_estimate.h"
#include "tools/interface/convert_recording.h"
#include "tools/interface/guarded.h"

namespace warmjoint::api {
namespace {

Estimate FromJson(const nlohmann::json& json, const models::Place& place) {
  Estimate estimate = FromEstimate(identification::EstimateFromJson(json, place));
  // the files that it tells of, where it tells of files, and the heat with which it began
  const auto holds = [&](const char* name) { return json.contains(name) && !json[name].is_null(); };
  if (holds("recording")) {
    tools::RecordingArguments arguments = tools::RecordingFromJson(json["recording"], place);
    if (holds("project")) arguments.project = tools::TakenProjectFromJson(json["project"], place);
    estimate.recording = FromArguments(arguments, place);
  }
  if (holds("follows")) {
    estimate.follows = FromCarried(tools::CarriedHeatFromJson(json["follows"], place));
  }
  return estimate;
}

/// target: the file, from whose folder its recordings are named.
std::string TextOf(const Estimate& estimate, const std::filesystem::path& target = {}) {
  std::optional<tools::RecordingArguments> source;
  if (estimate.recording) source = ToArguments(*estimate.recording);
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
  return Guarded([&] { return FromJson(models::ParseJson(text, name), {name}); });
}

Estimate ReadEstimate(const std::filesystem::path& file) {
  return Guarded([&] { return FromJson(models::ReadJsonFile(file), {file.string()}); });
}

void WriteEstimate(const Estimate& estimate, const std::filesystem::path& file) {
  Guarded([&] { models::WriteWholeFile(file, TextOf(estimate, file)); });
}

}  // namespace warmjoint::api

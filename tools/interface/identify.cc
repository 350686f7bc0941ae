#include <warmjoint/identify.h>

#include "identification/identifiers/identifier_list.h"
#include "models/foundation/bad_input.h"
#include "tools/actions/carried_heat.h"
#include "tools/actions/identify_recording.h"
#include "tools/interface/convert_estimate.h"
#include "tools/interface/convert_recording.h"
#include "tools/interface/guarded.h"

namespace warmjoint::api {
namespace {

/// The heat that an earlier recording left, less what cooled until `next` begins; none where none is given.
std::optional<tools::CarriedHeat> HeatBefore(const IdentifySettings& settings,
                                             const models::Measurements& next) {
  if (!settings.follows) return std::nullopt;
  const tools::LeftHeat left =
      tools::HeatLeftBy(ToEstimate(*settings.follows), "IdentifySettings::follows");
  tools::CarriedHeat heat = tools::CarryOver(left, settings.pause, next);
  // called by the recording that left it, where that was a file
  const std::optional<Origin>& origin = settings.follows->recording;
  if (origin && !origin->files.empty()) heat.file = origin->files.front();
  return heat;
}

tools::IdentifySettings ToSettings(const IdentifySettings& settings) {
  if (settings.pause && !settings.follows) {
    models::Refuse({"pause"},
                   "is the time since an earlier recording; give that one's estimate as follows");
  }
  // all under the same names
  tools::IdentifySettings made;
  made.identifier = settings.identifier;
  made.gravity = settings.gravity;
  made.start = settings.start;
  made.relevance = settings.relevance;
  made.options = settings.options;
  if (settings.void_numbers == VoidNumbers::show) made.void_numbers = tools::VoidNumbers::show;
  made.motion = settings.motion;
  made.follows = settings.follows.has_value();
  return made;
}

tools::HoldOutSource ToHoldOut(const IdentifySettings& settings) {
  // another recording, or a share of this one
  if (settings.holdout_log) return {0, settings.holdout_log->state().log};
  return tools::HoldOutShare(settings.holdout);
}

}  // namespace

std::vector<IdentifierInfo> Identifiers() {
  std::vector<IdentifierInfo> all;
  for (const identification::Identifier& identifier : identification::Identifiers()) {
    // each with its options, as the list of the command line has them
    IdentifierInfo info{identifier.name, identifier.summary, {}};
    for (const identification::OptionInfo& option : identifier.options.List()) {
      info.options.push_back({option.name, option.value, option.allowed, option.meaning});
    }
    all.push_back(std::move(info));
  }
  return all;
}

Estimate Identify(const PreparedLog& log, const IdentifySettings& settings) {
  return Guarded([&] {
    // as the command does: checked, identified, and with a friction in amperes marked
    const identification::PreparedLog& prepared = log.state().log;
    const models::Measurements& measurements = prepared.taken().measurements;
    tools::IdentifyTask task = tools::CheckSettings(ToSettings(settings), measurements.joint);
    const std::optional<tools::CarriedHeat> heat = HeatBefore(settings, measurements);
    if (heat) tools::BeginWith(*heat, task);
    identification::Estimate found =
        tools::IdentifyLog(task, prepared, ToHoldOut(settings)).estimate;
    tools::MarkAmperes(measurements, found);

    // as a value that remembers its files, and with what it began
    Estimate estimate = FromEstimate(found);
    estimate.recording = log.state().origin;
    if (heat) estimate.follows = FromCarried(*heat);
    return estimate;
  });
}

}  // namespace warmjoint::api

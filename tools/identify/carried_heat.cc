#include "tools/identify/carried_heat.h"

#include <fmt/format.h>
#include <warmjoint/friction_model.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "identification/fit/fit_parameters.h"
#include "identification/uncertainty/tails.h"
#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/node.h"
#include "models/foundation/parse_number.h"
#include "models/friction/thermal.h"

namespace warmjoint {
namespace {

constexpr const char* kStages[] = {"energy", "second_energy"};

/// The deviation that a 95 % interval stands for, whatever widened it; nothing where there is none.
std::optional<double> DeviationOf(const EstimatedParameter& one) {
  if (!one.interval95) return std::nullopt;
  const auto& [lower, upper] = *one.interval95;
  return (upper - lower) / (2 * StudentQuantile(kInfinity, kIntervalLevel));
}

const EstimatedParameter* FindIn(const std::vector<EstimatedParameter>& all,
                                 std::string_view name) {
  const auto found = std::ranges::find(all, name, &EstimatedParameter::name);
  return found == all.end() ? nullptr : &*found;
}

/// How long the joint paused by the stamps of both recordings.
double PauseByStamps(const LeftHeat& left, const Measurements& next) {
  const char* remedy =
      "give --pause SECONDS, from the last sample of the one to the first of the other";
  if (!left.stamp) {
    Refuse({"--follows"}, "{} does not tell when it ended: {}", left.file, remedy);
  }
  // stamps of one clock tell how long the joint rested
  const double pause = next.time[0] - *left.stamp;
  if (pause > 0) return pause;
  Refuse({"--follows"},
         "{} begins at {:.6g} s, and {} ends at {:.6g} s, so their stamps share no clock: {}",
         next.source, next.time[0], left.file, *left.stamp, remedy);
}

constexpr std::string_view kSettled = "settled:";

/// The heat at the end of a recording: {energy, second_energy} of state_end.
std::vector<double> EnergiesAtEnd(const Friction& friction, const std::string& file) {
  if (!friction.thermal) return {};
  const Place place{file};
  // only estimates of a warming joint tell the heat at the end
  const auto end = ReadJsonNode(file).Find("state_end");
  if (!end || !end->IsMap()) {
    Refuse(place,
           "has no state_end, the heat at the end of its recording; identify again, or give "
           "--initial cold or settled:SPEED");
  }
  std::vector<double> energies;
  // heat of each stage
  const auto add = [&](const char* key) {
    const auto given = end->Find(key);
    if (!given) Refuse(place, "state_end has no {}; identify again", key);
    // a number, or an object of its value, standard error and interval
    energies.push_back(given->Find("value").value_or(*given).Number());
  };
  add("energy");
  if (friction.second_thermal) add("second_energy");
  return energies;
}

std::vector<double> Settled(const std::string& text, const Friction& friction,
                            const std::string& file) {
  // the heat that the joint settles at when it moves at this speed for ever
  const auto speed = ParseNumber(text);
  if (!speed || !std::isfinite(*speed)) {
    Refuse({"--initial"}, "is settled:{}; the speed must be a number, rad/s or m/s, as settled:0.5",
           Excerpt(text));
  }
  // too fast, and the heat grows without end
  const auto energies = SettledEnergy(friction, *speed);
  if (energies) return *energies;
  Refuse({file},
         "its friction never settles at {} rad/s or m/s: thermal_gain times the speed must stay "
         "below 1; give a smaller speed to --initial",
         *speed);
}

/// What an estimate's verdict says against its friction; empty where there is nothing.
std::string WarningOf(const std::string& path) {
  const Tree object = ReadJsonFile(path);
  if (!object.is_object() || !object.contains("status") || object["status"] == "ok") return "";
  const std::string status =
      object["status"].is_string() ? Excerpt(object["status"].get<std::string>()) : "of no status";
  // an estimate without numbers cannot become a model
  if (object.contains("friction") && object["friction"].is_null()) {
    Refuse({path}, "is {} and holds no friction; identify again with --force to use it anyway",
           status);
  }
  return fmt::format("{} is {}: its friction is void, and so is that of the model", path, status);
}

/// Whether a file is an estimate.json (or another JSON document), not a recording.
bool IsJsonFile(const std::string& file) {
  if (IsStandardInput(file)) return false;
  std::ifstream stream(file);
  char first = 0;
  stream >> first;
  return first == '{';
}

}  // namespace

std::vector<double> InitialEnergies(const std::string& initial, const Friction& friction,
                                    const std::string& file) {
  if (initial == "cold") return {};
  if (initial == "end") return EnergiesAtEnd(friction, file);
  if (initial.starts_with(kSettled)) {
    return Settled(initial.substr(kSettled.size()), friction, file);
  }
  Refuse({"--initial"}, "is '{}'; it must be cold, end or settled:SPEED", Excerpt(initial));
}

void CheckEarlier(const EarlierRecording& earlier, size_t recordings) {
  // each option alone makes no sense
  if (earlier.pause && !earlier.is_given()) {
    Refuse({"--pause"}, "is the time since an earlier recording; name that with --follows");
  }
  if (earlier.is_given() && recordings > 1) {
    Refuse({"--follows"}, "is for one recording, and {} are given, which begin cold each",
           recordings);
  }
}

std::optional<LeftHeat> HeatLeftIn(const std::string& file) {
  if (!IsJsonFile(file)) return std::nullopt;
  return HeatLeftBy(ReadEstimate(file), file);
}

LeftHeat HeatLeftBy(const Estimate& estimate, const std::string& file) {
  const Place place{file};
  // without warming there is no heat to follow
  if (!FindIn(estimate.state_end, kStages[0])) {
    const bool ok = estimate.status == Status::ok;
    Refuse(place, "tells of no heat at its end, so nothing can follow it: {}",
           ok ? std::string("its estimate knows no warming; take energy-ml")
              : fmt::format("identified by itself it is {} ({})", StatusName(estimate.status),
                            estimate.message));
  }
  LeftHeat left{file, {}, FindIn(estimate.state_end, kStages[0])->unit, {}};
  if (const EstimatedParameter* time = FindIn(estimate.state_end, "time")) left.stamp = time->value;

  // its stages, each with its time constant
  for (const auto& [name, thermal, prefix] :
       {std::tuple(kStages[0], estimate.friction ? estimate.friction->thermal : std::nullopt,
                   std::string_view()),
        std::tuple(kStages[1], estimate.friction ? estimate.friction->second_thermal : std::nullopt,
                   kSecondStage)}) {
    const EstimatedParameter* energy = FindIn(estimate.state_end, name);
    if (!energy) continue;
    // what is left after a pause needs the heat, its doubt and a time constant
    const std::optional<double> deviation = DeviationOf(*energy);
    if (!thermal || !deviation) {
      Refuse(place, "its state_end.{} has no {}, so nothing is known of what is left after a pause",
             name, thermal ? "interval" : "time constant");
    }
    // how sure the time constant is
    const EstimatedParameter* tau =
        estimate.Find(fmt::format("{}{}", prefix, NameOf(Role::time_constant)));
    const double tau_deviation = tau ? DeviationOf(*tau).value_or(0) : 0;
    left.stages.push_back({energy->value, *deviation, thermal->time_constant, tau_deviation});
  }
  return left;
}

CarriedHeat CarryOver(const LeftHeat& left, std::optional<double> pause, const Measurements& next) {
  // heat and torque have to be in one unit, and time runs forwards
  if (left.unit != next.torque_unit) {
    Refuse({"--follows"}, "{} holds its heat in {} and the torque of {} is in {}", left.file,
           left.unit, next.source, next.torque_unit);
  }
  if (pause && !(*pause >= 0 && std::isfinite(*pause))) {
    Refuse({"--pause"}, "is {}; it must be a number of seconds, 0 or more", *pause);
  }
  // a pause that is given goes before one that stamps tell
  CarriedHeat carried{left.file,
                      pause ? *pause : PauseByStamps(left, next),
                      pause ? "given" : "stamps",
                      left.unit,
                      {},
                      {}};
  // each stage cools by exp(-pause / time constant)
  for (const LeftStage& stage : left.stages) {
    const double times = carried.pause / stage.time_constant, kept = std::exp(-times);
    carried.energy.push_back(stage.energy * kept);
    // doubts of the heat and of its time constant are added, as if they went together
    const double by_time_constant =
        std::abs(stage.energy) * kept * times * stage.time_constant_std / stage.time_constant;
    carried.std.push_back(stage.std * kept + by_time_constant);
  }
  return carried;
}

std::string Describe(const CarriedHeat& carried) {
  std::string energies;
  for (size_t i = 0; i < carried.energy.size(); ++i) {
    energies += fmt::format("{}{:.4g}", i > 0 ? " and " : "", carried.energy[i]);
    if (carried.std[i] > 0) energies += fmt::format(" +- {:.2g}", carried.std[i]);
  }
  return fmt::format(
      "E(0) is expected at {} {}, which {} left, after a pause of {:.6g} s ({}) at rest", energies,
      carried.unit, carried.file, carried.pause,
      carried.pause_from == "stamps" ? "by the stamps" : "given");
}

FrictionForJoint ReadFrictionForJoint(const std::string& joint, const std::string& file,
                                      const std::string& initial,
                                      std::vector<std::string>& warnings) {
  std::string warning = WarningOf(file);
  if (!warning.empty()) warnings.push_back(std::move(warning));
  FrictionForJoint friction{joint, ReadFriction(file)};
  friction.initial_energy = InitialEnergies(initial, friction.friction, file);
  return friction;
}

}  // namespace warmjoint

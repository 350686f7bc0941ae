#include "identification/adequacy/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "identification/adequacy/examine.h"
#include "identification/adequacy/words.h"
#include "identification/fit_data.h"
#include "identification/preparation/finer_input.h"
#include "identification/preparation/log_faults.h"
#include "identification/warming/gaps.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;

constexpr double kNormal95 = 1.96;
constexpr double kLarge = 0.05;    // of the friction, rms
constexpr double kNotable = 0.02;  // of the friction, rms, where it also is
constexpr double kVisible = 0.2;   // of the residual's variance

/// Whether structure that explains so much is more than a detail.
bool IsLarge(double explained, const Adequacy& adequacy) {
  const double size = std::sqrt(explained / adequacy.samples) / adequacy.friction;
  return size > kLarge || (size > kNotable && explained > kVisible * adequacy.squares);
}

/// Of the interval; 0 where there is none.
double HalfWidth(const EstimatedParameter& parameter) {
  if (!parameter.interval95) return 0;
  return 0.5 * ((*parameter.interval95)[1] - (*parameter.interval95)[0]);
}

/// The parameter that structure moves farthest beyond its interval, by a twentieth of the friction
/// at least; -1 where there is none.
Index Misled(const Adequacy& adequacy, const Estimate& estimate) {
  Index worst = -1;
  double most = kLarge * adequacy.friction;
  for (Index i = 0; i < adequacy.moves.size(); ++i) {
    const EstimatedParameter* parameter = estimate.Find(adequacy.names[static_cast<size_t>(i)]);
    const double move = std::abs(adequacy.moves[i]);
    if (move < kCertainMove * adequacy.move_deviations[i] || move < HalfWidth(*parameter)) continue;
    if (move * adequacy.reach[i] < most) continue;
    most = move * adequacy.reach[i];
    worst = i;
  }
  return worst;
}

/// Whether something changes that the warming may have taken up in part.
bool Drifts(const Adequacy& adequacy) {
  return std::any_of(adequacy.found.begin(), adequacy.found.end(), [](const Structure& structure) {
    return structure.on == Dependence::time || structure.on == Dependence::energy;
  });
}

bool IsOfHeat(const EstimatedParameter& parameter) {
  return parameter.name.starts_with("thermal_") || parameter.name == "initial_energy";
}

/// How far each parameter moves by name, the discrete warming's too. (4): k, tau to ke, te. by: [p]
std::map<std::string, double> Moves(const Adequacy& adequacy, const Eigen::VectorXd& by,
                                    const Estimate& estimate, const Measurements& m) {
  std::map<std::string, double> moves;
  for (size_t i = 0; i < adequacy.names.size(); ++i) {
    moves[adequacy.names[i]] = std::abs(by[static_cast<Index>(i)]);
  }
  if (!moves.contains("thermal_gain")) return moves;
  const Thermal thermal{estimate.Find("thermal_gain")->value,
                        estimate.Find("thermal_time_constant")->value};
  const double h = MedianStep(m.time), gain = moves["thermal_gain"];
  const DiscreteThermal discrete = Discretise(thermal, h);
  const double pole =
      discrete.pole * h / std::pow(thermal.time_constant, 2) * moves["thermal_time_constant"];
  moves["thermal_pole"] = pole;
  moves["thermal_gain_discrete"] = (1 - discrete.pole) * gain + std::abs(thermal.gain) * pole;
  return moves;
}

/// What drifts is partly taken up by the warming, by how much cannot be known: no interval of it is
/// left.
void DropWarming(Estimate& estimate) {
  for (EstimatedParameter& parameter : estimate.parameters) {
    if (IsOfHeat(parameter)) parameter.std = {}, parameter.interval95 = {};
  }
}

/// Lets intervals reach as far as something moves the parameters. by: [p]
void Widen(const Adequacy& adequacy, const Eigen::VectorXd& by, const Measurements& m,
           Estimate& estimate) {
  const std::map<std::string, double> moves = Moves(adequacy, by, estimate, m);
  for (EstimatedParameter& parameter : estimate.parameters) {
    const auto move = moves.find(parameter.name);
    if (!parameter.interval95 || move == moves.end()) continue;
    (*parameter.interval95)[0] -= move->second;
    (*parameter.interval95)[1] += move->second;
  }
}

/// Moves the parameters with their intervals. by: [p]
void Shift(const Adequacy& adequacy, const Eigen::VectorXd& by, const Measurements& m,
           Estimate& estimate) {
  const auto shift = [&](std::string_view name, double move) {
    for (EstimatedParameter& parameter : estimate.parameters) {
      if (parameter.name != name) continue;
      parameter.value += move;
      if (!parameter.interval95) continue;
      for (double& end : *parameter.interval95) end += move;
    }
  };
  const auto value = [&](std::string_view name) { return estimate.Find(name)->value; };
  for (size_t i = 0; i < adequacy.names.size(); ++i) {
    shift(adequacy.names[i], by[static_cast<Index>(i)]);
  }
  const Thermal thermal{value("thermal_gain"), value("thermal_time_constant")};
  const DiscreteThermal discrete = Discretise(thermal, MedianStep(m.time));
  if (estimate.Find("thermal_pole")) {
    shift("thermal_pole", discrete.pole - value("thermal_pole"));
    shift("thermal_gain_discrete", discrete.gain - value("thermal_gain_discrete"));
  }
  if (!estimate.friction) return;
  estimate.friction->thermal = thermal;
  for (auto& [name, number] : estimate.friction->parameters) number = value(name);
}

/// Where the log's step matters to the warming: the parameters of heat that is followed within the
/// steps where the residual tells that it is; where it cannot tell, intervals that hold both.
void FollowHeat(const Adequacy& adequacy, const Measurements& m, Estimate& estimate) {
  if (adequacy.by_heat.size() == 0) return;
  const double share = adequacy.heat_share, sure = kCertain * adequacy.heat_deviation;
  const double fits = kCertainMove * adequacy.heat_deviation;
  if (1 - share > sure && std::abs(share) < fits) return;
  const auto tau = std::ranges::find(adequacy.names, "thermal_time_constant");
  const std::string what = fmt::format(
      "Eq. (22) holds the losses over each step of {:.3g} s; losses that follow the "
      "heat within it move thermal_time_constant by {:.2g} s",
      MedianStep(m.time), adequacy.by_heat[tau - adequacy.names.begin()]);
  if (share > sure && std::abs(1 - share) < fits) {
    estimate.warnings.push_back(fmt::format("{}, and fit better: the numbers are theirs", what));
    Shift(adequacy, adequacy.by_heat, m, estimate);
  } else {
    estimate.warnings.push_back(fmt::format("{}: the intervals hold both; log faster", what));
    Widen(adequacy, adequacy.by_heat, m, estimate);
  }
}

/// Lets intervals reach as far as the gaps of the log may have moved the parameters.
void WidenByGaps(const Adequacy& adequacy, const Measurements& m, Estimate& estimate) {
  if (adequacy.by_gaps.size() == 0) return;
  estimate.warnings.push_back(fmt::format(
      "{}: what the joint lost there is not known: the intervals reach as far as that may move "
      "them; record without gaps",
      DescribeGaps(FindGaps(m), m)));
  Widen(adequacy, adequacy.by_gaps, m, estimate);
}

/// "; taken to be cold at the start: ..." where a warm one would move a parameter beyond its
/// interval; else nothing.
std::string OnTheStart(const Adequacy& adequacy, const Identifier& identifier,
                       const IdentifierInput& input, const Estimate& estimate) {
  const EstimatedParameter* worst = nullptr;
  double most = 1, move = 0;
  for (Index i = 0; i < adequacy.by_start.size(); ++i) {
    const EstimatedParameter* parameter = estimate.Find(adequacy.names[static_cast<size_t>(i)]);
    const double beyond = std::abs(adequacy.by_start[i]) / HalfWidth(*parameter);
    if (!std::isfinite(beyond) || beyond <= most) continue;
    most = beyond;
    worst = parameter;
    move = adequacy.by_start[i];
  }
  if (!worst) return "";
  return fmt::format(
      "; taken to be cold at the start: a tenth of the warmth that it reaches would move {} by "
      "{:.2g} {}; {}",
      worst->name, move, worst->unit, AgainstWarmStart(identifier, input));
}

}  // namespace

void JudgeAdequacy(const Identifier& identifier, const IdentifierInput& input, Estimate& estimate) {
  if (estimate.status != Status::ok) return;
  const Adequacy adequacy = ExamineResidual(identifier, input, estimate);
  const std::string start = OnTheStart(adequacy, identifier, input, estimate);
  FollowHeat(adequacy, input.measurements, estimate);
  WidenByGaps(adequacy, input.measurements, estimate);
  if (adequacy.found.empty()) {
    estimate.message += start;
    return;
  }

  std::vector<std::string> words;
  double explained = 0;
  for (const Structure& structure : adequacy.found) {
    words.push_back(DescribeStructure(adequacy, structure, input.measurements));
    explained += structure.explained;
  }
  const std::string depends =
      fmt::format("the residual depends on {}", fmt::join(words, "; and on "));
  const std::string remedy = Remedy(adequacy.found[0], identifier, input, estimate);
  const Index misled = Misled(adequacy, estimate);
  if (IsLarge(explained, adequacy) || misled >= 0) {
    const std::string moves = misled < 0 ? ""
                                         : fmt::format("; with it {} would move by {:.3g}",
                                                       adequacy.names[static_cast<size_t>(misled)],
                                                       adequacy.moves[misled]);
    estimate.bands.clear();
    Void(Status::inadequate_model, fmt::format("{}{}; {}", depends, moves, remedy), estimate);
    return;
  }
  const bool unknown = Drifts(adequacy) && estimate.Find("thermal_gain");
  estimate.message += start;
  estimate.warnings.push_back(fmt::format(
      "{}: the intervals reach as far as that moves them{}; {}", depends,
      unknown ? ", and the warming has none, since it may have taken up part of that" : "",
      remedy));
  if (Drifts(adequacy)) DropWarming(estimate);
  const Eigen::VectorXd most = adequacy.moves.cwiseAbs() + kNormal95 * adequacy.move_deviations;
  Widen(adequacy, most, input.measurements, estimate);
}

Estimate WithVoidNumbers(const Estimate& judged, const Estimate& before) {
  if (judged.status == before.status) return judged;
  Estimate shown = judged;
  shown.parameters = before.parameters;
  shown.friction = before.friction;
  shown.bands = before.bands;
  shown.message += "; forced: all numbers are void";
  return shown;
}

Judgement IdentifyAndJudge(const Identifier& identifier, const FinerInput& finer) {
  Judgement judgement{identifier.identify(finer.input()), {}};
  judgement.judged = judgement.before;
  const IdentifierInput& given = finer.given();
  const std::vector<std::string> faults = FindFaults(given.measurements, given.selection);
  if (faults.empty()) {
    JudgeAdequacy(identifier, finer.input(), judgement.judged);
    WarnOfUnseenReversals(finer.unseen(), judgement.judged);
    if (finer.velocity()) TellSegmentVelocity(*finer.velocity(), judgement.judged);
  } else {
    Void(Status::bad_data, fmt::format("{}", fmt::join(faults, "; and ")), judgement.judged);
  }
  return judgement;
}

Estimate IdentifyAndJudge(const Identifier& identifier, const IdentifierInput& given) {
  return IdentifyAndJudge(identifier, FinerInput(identifier, given)).judged;
}

}  // namespace warmjoint::inline identification

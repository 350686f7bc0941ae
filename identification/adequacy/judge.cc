#include "identification/adequacy/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "identification/adequacy/examine.h"
#include "identification/adequacy/words.h"
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

/// The parameter that structure moves farthest beyond its interval, by a twentieth of the friction
/// at least; -1 where there is none.
Index Misled(const Adequacy& adequacy, const Inference& inference) {
  Index worst = -1;
  double most = kLarge * adequacy.friction;
  for (Index i = 0; i < adequacy.moves.size(); ++i) {
    const KnownParameter& known = inference.parameters[adequacy.rows[static_cast<size_t>(i)]];
    const double move = std::abs(adequacy.moves[i]);
    if (move < kCertainMove * adequacy.move_deviations[i] || move < known.HalfWidth()) continue;
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

/// What drifts is partly taken up by the warming, by how much cannot be known: no interval of it is
/// left.
void DropWarming(const Fit& fit, Inference& inference) {
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const Role role = fit.parameters[i].role;
    if (role != Role::heat && role != Role::start) continue;
    inference.parameters[i].std.reset();
    inference.parameters[i].interval95.reset();
  }
}

/// Lets intervals reach as far as something moves the parameters. by: [p]
void Widen(const Adequacy& adequacy, const Eigen::VectorXd& by, Inference& inference) {
  for (size_t i = 0; i < adequacy.rows.size(); ++i) {
    inference.Widen(adequacy.rows[i], by[static_cast<Index>(i)]);
  }
}

/// Moves the parameters with their intervals. by: [p]
void Shift(const Adequacy& adequacy, const Eigen::VectorXd& by, Inference& inference) {
  for (size_t i = 0; i < adequacy.rows.size(); ++i) {
    KnownParameter& known = inference.parameters[adequacy.rows[i]];
    const double move = by[static_cast<Index>(i)];
    known.value += move;
    if (!known.interval95) continue;
    for (double& end : *known.interval95) end += move;
  }
}

/// Where the log's step matters to the warming: the parameters of heat that is followed within the
/// steps where the residual tells that it is; where it cannot tell, intervals that hold both.
void FollowHeat(const Adequacy& adequacy, const Fit& fit, const Measurements& m,
                Inference& inference) {
  if (adequacy.by_heat.size() == 0) return;
  const double share = adequacy.heat_share, sure = kCertain * adequacy.heat_deviation;
  const double fits = kCertainMove * adequacy.heat_deviation;
  if (1 - share > sure && std::abs(share) < fits) return;
  const auto tau = std::ranges::find(adequacy.rows, *fit.RowOf(Role::heat, 1));
  const std::string what = fmt::format(
      "Eq. (22) holds the losses over each step of {:.3g} s; losses that follow the "
      "heat within it move thermal_time_constant by {:.2g} s",
      MedianStep(m.time), adequacy.by_heat[tau - adequacy.rows.begin()]);
  if (share > sure && std::abs(1 - share) < fits) {
    inference.warnings.push_back(fmt::format("{}, and fit better: the numbers are theirs", what));
    Shift(adequacy, adequacy.by_heat, inference);
  } else {
    inference.warnings.push_back(fmt::format("{}: the intervals hold both; log faster", what));
    Widen(adequacy, adequacy.by_heat, inference);
  }
}

/// Lets intervals reach as far as the gaps of the log may have moved the parameters.
void WidenByGaps(const Adequacy& adequacy, const Measurements& m, Inference& inference) {
  if (adequacy.by_gaps.size() == 0) return;
  inference.warnings.push_back(fmt::format(
      "{}: what the joint lost there is not known: the intervals reach as far as that may move "
      "them; record without gaps",
      DescribeGaps(FindGaps(m), m)));
  Widen(adequacy, adequacy.by_gaps, inference);
}

/// "; taken to be cold at the start: ..." where a warm one would move a parameter beyond its
/// interval; else nothing.
std::string OnTheStart(const Adequacy& adequacy, const Identifier& identifier,
                       const IdentifierInput& input, const Fit& fit, const Inference& inference) {
  std::optional<size_t> worst;
  double most = 1, move = 0;
  for (Index i = 0; i < adequacy.by_start.size(); ++i) {
    const size_t row = adequacy.rows[static_cast<size_t>(i)];
    const double beyond = std::abs(adequacy.by_start[i]) / inference.parameters[row].HalfWidth();
    if (!std::isfinite(beyond) || beyond <= most) continue;
    most = beyond;
    worst = row;
    move = adequacy.by_start[i];
  }
  if (!worst) return "";
  return fmt::format(
      "; taken to be cold at the start: a tenth of the warmth that it reaches would move {} by "
      "{:.2g} {}; {}",
      fit.parameters[*worst].name, move, fit.parameters[*worst].unit,
      AgainstWarmStart(identifier, input));
}

/// Voids an inference that structure makes wrong, or warns of it and widens the intervals.
void WeighStructure(const Adequacy& adequacy, const Identifier& identifier,
                    const IdentifierInput& input, const std::string& start, const Fit& fit,
                    Inference& inference) {
  std::vector<std::string> words;
  double explained = 0;
  for (const Structure& structure : adequacy.found) {
    words.push_back(DescribeStructure(adequacy, structure, input.measurements));
    explained += structure.explained;
  }
  const std::string depends =
      fmt::format("the residual depends on {}", fmt::join(words, "; and on "));
  const std::string remedy = Remedy(adequacy.found[0], identifier, input, fit);

  // too large to live with
  const Index misled = Misled(adequacy, inference);
  if (IsLarge(explained, adequacy) || misled >= 0) {
    const std::string moves =
        misled < 0 ? ""
                   : fmt::format("; with it {} would move by {:.3g}",
                                 fit.parameters[adequacy.rows[static_cast<size_t>(misled)]].name,
                                 adequacy.moves[misled]);
    inference.Void(Status::inadequate_model, fmt::format("{}{}; {}", depends, moves, remedy));
    return;
  }

  // small: the intervals hold it
  const bool unknown = Drifts(adequacy) && fit.RowOf(Role::heat);
  inference.message += start;
  inference.warnings.push_back(fmt::format(
      "{}: the intervals reach as far as that moves them{}; {}", depends,
      unknown ? ", and the warming has none, since it may have taken up part of that" : "",
      remedy));
  if (Drifts(adequacy)) DropWarming(fit, inference);
  Widen(adequacy, adequacy.moves.cwiseAbs() + kNormal95 * adequacy.move_deviations, inference);
}

}  // namespace

void JudgeAdequacy(const Identifier& identifier, const IdentifierInput& input, const Fit& fit,
                   Inference& inference) {
  if (inference.status != Status::ok) return;
  const Measurements& m = input.measurements;
  const Adequacy adequacy = ExamineResidual(fit, inference, m, input.selection);
  const std::string start = OnTheStart(adequacy, identifier, input, fit, inference);
  FollowHeat(adequacy, fit, m, inference);
  WidenByGaps(adequacy, m, inference);
  if (adequacy.found.empty()) {
    inference.message += start;
  } else {
    WeighStructure(adequacy, identifier, input, start, fit, inference);
  }
}

}  // namespace warmjoint::inline identification

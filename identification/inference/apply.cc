#include "identification/inference/apply.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "identification/uncertainty/tails.h"

namespace warmjoint {
namespace {

/// Changes the value of a row of the table to that where other rows are held at their bounds; its interval stays that of noise.
void Hold(const std::vector<Cause>& causes, std::size_t row, ParameterInterval& estimated) {
  for (const Cause& cause : causes) {
    if (cause.action == Action::hold) estimated.value += cause.BiasOf(row);
  }
}

void Apply(const FigureChange& change, ParameterInterval& estimated) {
  if (!change.has_interval) {
    estimated.std.reset();
    estimated.interval95.reset();
  }
  if (!estimated.interval95) {
    estimated.value += change.shift;
    return;
  }
  std::ranges::move(Move(change, estimated.value, *estimated.interval95),
                    std::back_inserter(estimated.parts));
}

/// Applies all rows to the friction at speeds, and drops the figures that depend on a number without an interval.
void Apply(const std::vector<Cause>& causes, std::vector<SpeedFigure>& at_speeds) {
  std::vector<bool> stays(at_speeds.size(), true);
  for (const Cause& cause : causes) {
    for (const std::size_t i : cause.without_speed) stays[i] = false;
  }
  std::vector<SpeedFigure> left;
  for (std::size_t i = 0; i < at_speeds.size(); ++i) {
    SpeedFigure& one = at_speeds[i];
    const FigureChange change = ChangeOf(causes, one.derivatives, About::friction);
    if (!stays[i] || !change.has_interval) continue;
    std::ranges::move(Move(change, one.at.value, one.at.interval95), std::back_inserter(one.parts));
    left.push_back(std::move(one));
  }
  at_speeds = std::move(left);
}

/// The row by which the answer is refused; nullptr where none does.
const Cause* RefusalOf(const std::vector<Cause>& causes) {
  const Cause* worst = nullptr;
  for (const Cause& cause : causes) {
    if (cause.action != Action::refuse) continue;
    if (!worst || cause.status > worst->status) worst = &cause;
  }
  return worst;
}

}  // namespace

Inference Apply(Inference answer, std::vector<Cause> causes) {
  std::ranges::stable_sort(causes, {}, &Cause::source);
  // the numbers
  const auto count = std::ssize(answer.parameters);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto row = static_cast<std::size_t>(i);
    Hold(causes, row, answer.parameters[row]);
    Apply(ChangeOf(causes, Eigen::VectorXd::Unit(count, i), About::parameters),
          answer.parameters[row]);
  }
  Apply(causes, answer.at_speeds);

  // the status; refused values are kept, without what would make them look certain
  const Cause* const refusal = RefusalOf(causes);
  if (refusal) {
    answer.status = refusal->status;
    answer.message = refusal->sentence;
    answer.warnings.clear();
    answer.gives_friction = false;
    answer.at_speeds.clear();
    for (ParameterInterval& one : answer.parameters) {
      one.std.reset();
      one.interval95.reset();
    }
  }

  // what is said of it
  const bool is_ok = answer.status == Status::ok;
  for (const Cause& cause : causes) {
    if (cause.action == Action::refuse || cause.sentence.empty()) continue;
    if (!is_ok && cause.sentence_in != SentenceIn::any_answer) continue;
    if (cause.sentence_in == SentenceIn::message) {
      answer.message += "; " + cause.sentence;
    } else {
      answer.warnings.push_back(cause.sentence);
    }
  }
  std::ranges::move(causes, std::back_inserter(answer.causes));
  return answer;
}

namespace {

/// The most by which a cause may change a figure. by: [p] its derivatives by the cause's rows
double MostOf(const Cause& cause, const Eigen::VectorXd& by) {
  double most = 0;
  for (Eigen::Index i = 0; i < by.size(); ++i) {
    if (by[i] != 0) most += std::abs(by[i]) * cause.most[i];
  }
  return most;
}

}  // namespace

FigureChange ChangeOf(const std::vector<Cause>& causes, const Eigen::VectorXd& derivatives,
                      About of) {
  FigureChange change;
  std::map<Source, double> widened;
  for (const Cause& cause : causes) {
    // where no number has an interval, no figure that depends on it has one
    if (cause.action == Action::drop_intervals) change.has_interval = false;
    for (const std::size_t row : cause.without_interval) {
      if (derivatives[static_cast<Eigen::Index>(row)] != 0) change.has_interval = false;
    }
    if (cause.action == Action::note || cause.bias.size() == 0) continue;
    if (cause.about != About::all && cause.about != of) continue;

    const Eigen::VectorXd by = derivatives(cause.rows);
    const double bias = by.dot(cause.bias);
    if (cause.action == Action::shift) change.shift += bias;
    if (cause.action == Action::widen) {
      double reach = std::abs(bias);
      if (cause.spread.size() > 0) reach += kNormal95 * (by.transpose() * cause.spread).norm();
      if (cause.most.size() > 0) reach = std::min(reach, MostOf(cause, by));
      double& most = widened[cause.source];
      most = std::max(most, reach);
    }
    if (cause.action == Action::cover && bias != 0) {
      (bias < 0 ? change.below : change.above) += std::abs(bias);
      change.covered.push_back({cause.source, std::abs(bias)});
    }
  }
  for (const auto& [source, reach] : widened) {
    change.reach += reach;
    if (reach > 0) change.parts.push_back({source, reach});
  }
  return change;
}

std::vector<WidthPart> Move(const FigureChange& change, double& value,
                            std::array<double, 2>& interval) {
  auto& [lower, upper] = interval;
  const double half = 0.5 * (upper - lower), middle = 0.5 * (lower + upper);
  // the value may be anywhere in a range
  const double range = change.below + change.above;
  if (range > 0 && half > 0) {
    const double reach = half * ReachBeyondEnds(kNormal95 * range / half) / kNormal95;
    lower = middle - change.below - reach;
    upper = middle + change.above + reach;
  }
  const double covered = 0.5 * (upper - lower) - half;
  value += change.shift;
  lower += change.shift - change.reach;
  upper += change.shift + change.reach;

  // the sources that cover share what they add to the half width
  std::vector<WidthPart> parts = change.parts;
  for (WidthPart part : change.covered) {
    part.half_width *= range > 0 ? covered / range : 0;
    parts.push_back(part);
  }
  return parts;
}

}  // namespace warmjoint

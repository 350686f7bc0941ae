#include "identification/inference/apply.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "identification/uncertainty/tails.h"

namespace warmjoint {
namespace {

/// What all rows do to one parameter, in its unit.
struct Change {
  double shift = 0;
  double reach = 0;             // of either end of the interval
  double below = 0, above = 0;  // how far the value may lie from itself, of rows that cover
  bool has_interval = true;
};

/// One for each row of the fit's table.
std::vector<Change> ChangesBy(const std::vector<Cause>& causes, std::size_t count) {
  std::vector<Change> changes(count);
  // a fit without numbers has none to change
  if (count == 0) return changes;
  for (const Cause& cause : causes) {
    for (const std::size_t row : cause.without_interval) changes[row].has_interval = false;
    if (cause.action == Action::drop_intervals) {
      for (Change& change : changes) change.has_interval = false;
    }
    if (cause.action == Action::note || cause.bias.size() == 0) continue;
    for (std::size_t i = 0; i < cause.rows.size(); ++i) {
      const double bias = cause.bias[static_cast<Eigen::Index>(i)], reach = ReachOf(cause, i);
      Change& change = changes[cause.rows[i]];
      if (cause.action == Action::shift) change.shift += bias;
      if (cause.action == Action::widen) change.reach += reach;
      if (cause.action == Action::cover) (bias < 0 ? change.below : change.above) += reach;
    }
  }
  return changes;
}

void Apply(const Change& change, ParameterInterval& known) {
  known.value += change.shift;
  known.widened += change.reach + change.below + change.above;
  if (!change.has_interval) {
    known.std.reset();
    known.interval95.reset();
  }
  if (!known.interval95) return;

  // noise around either end of what is covered: an interval that holds the one that is true
  auto& [lower, upper] = *known.interval95;
  const double half = known.HalfWidth(), middle = 0.5 * (lower + upper);
  if (const double apart = change.below + change.above; apart > 0 && half > 0) {
    const double reach = half * ReachBeyondEnds(kNormal95 * apart / half) / kNormal95;
    lower = middle - change.below - reach;
    upper = middle + change.above + reach;
  }
  lower += change.shift - change.reach;
  upper += change.shift + change.reach;
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
  const std::vector<Change> changes = ChangesBy(causes, answer.parameters.size());
  for (std::size_t i = 0; i < changes.size(); ++i) Apply(changes[i], answer.parameters[i]);

  // the status; values that are refused stay, without what would make them look sure
  const Cause* const refusal = RefusalOf(causes);
  if (refusal) {
    answer.status = refusal->status;
    answer.message = refusal->sentence;
    answer.warnings.clear();
    answer.gives_friction = false;
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

double ReachOf(const Cause& cause, std::size_t i) {
  if (cause.bias.size() == 0) return 0;
  const auto at = static_cast<Eigen::Index>(i);
  const double bias = std::abs(cause.bias[at]);
  if (cause.action == Action::cover) return bias;
  if (cause.action != Action::widen) return 0;
  return bias + kNormal95 * (cause.spread.size() > 0 ? cause.spread[at] : 0);
}

FigureChange ChangeOf(const std::vector<Cause>& causes, const Eigen::VectorXd& derivatives) {
  FigureChange change;
  for (const Cause& cause : causes) {
    if (cause.bias.size() == 0) continue;
    const Eigen::VectorXd by = derivatives(cause.rows);
    const double bias = by.dot(cause.bias);
    if (cause.action == Action::shift) change.shift += bias;
    if (cause.action != Action::widen && cause.action != Action::cover) continue;
    change.reach += std::abs(bias);
    if (cause.spread.size() > 0) change.reach += kNormal95 * by.cwiseProduct(cause.spread).norm();
  }
  return change;
}

}  // namespace warmjoint

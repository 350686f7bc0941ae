// All that changes an answer or has to be said about it, as rows of one list.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/field.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "identification/command.h"

namespace warmjoint {

/// What a row is about, in the order in which sentences are read.
enum class Source {
  // the parts of an interval by noise; they are no causes
  noise,
  white_noise,
  autocorrelated_noise,
  few_segments,
  description,
  field_over_place,
  field_over_speed,
  field_over_time,
  field_strength,
  // reasons that refuse an answer by themselves
  weight,
  fit,
  bound,
  faults,
  few_samples,
  no_friction,
  impossible,
  late_torque,
  worse_than_mean,
  unknown_friction,
  own_law,
  // what no test can see
  cold_start,
  open_start,
  slow_drift,
  open_drift,
  open_curve,
  open_memory,
  dead_band,
  offset,
  degrees,
  clock,
  // what the log does not determine
  held_losses,
  gaps,
  rounding,
  hidden_steps,
  // what tests for lack of fit found in the residual
  structure,
  findings,
  hidden_means,
  unadjusted_findings,
  // how the log was prepared
  reversals,
  preparation,
  velocity_averaged,
  velocity_noise,
  recording
};

/// Names in estimate.json, of assumptions and of what makes intervals reach farther.
inline std::span<const Word<Source>> WordsOf(Source) {
  using enum Source;
  static constexpr std::array words{Word{"noise", noise},
                                    Word{"white_noise", white_noise},
                                    Word{"few_segments", few_segments},
                                    Word{"description", description},
                                    Word{"field_over_place", field_over_place},
                                    Word{"field_over_speed", field_over_speed},
                                    Word{"field_over_time", field_over_time},
                                    Word{"field_strength", field_strength},
                                    Word{"autocorrelated_noise", autocorrelated_noise},
                                    Word{"structure", structure},
                                    Word{"cold_start", cold_start},
                                    Word{"open_start", open_start},
                                    Word{"no_slow_drift", slow_drift},
                                    Word{"open_drift", open_drift},
                                    Word{"open_curve", open_curve},
                                    Word{"open_memory", open_memory},
                                    Word{"no_dead_band", dead_band},
                                    Word{"no_offset", offset},
                                    Word{"angles_in_radians", degrees},
                                    Word{"true_clock", clock},
                                    Word{"late_torque", late_torque},
                                    Word{"held_losses", held_losses},
                                    Word{"gaps", gaps},
                                    Word{"hidden_steps", hidden_steps},
                                    Word{"findings", findings},
                                    Word{"hidden_means", hidden_means},
                                    Word{"unadjusted_findings", unadjusted_findings},
                                    Word{"velocity_noise", velocity_noise}};
  return words;
}

/// What a row does to an answer.
enum class Action {
  note,   // has a sentence, changes nothing
  widen,  // intervals reach farther by |bias| + 1.96 deviations of it
  cover,  // intervals hold the value both with and without the bias, with noise around either
  drop_intervals,  // no number has an interval
  shift,           // values and intervals are shifted by the bias
  hold,            // values of parameters are shifted by the bias, and their intervals stay
  refuse,          // no interval, friction or band; the answer's status is the row's
};

/// Numbers that a row may be about.
enum class About {
  all,
  parameters,
  friction  // at speeds and along maps
};

/// A sentence is a warning, ends the message, or is a warning that a refused answer has, too: it is about the log.
enum class SentenceIn { warning, message, any_answer };

struct Cause {
  Source source = Source::fit;
  Action action = Action::note;
  About about = About::all;         // the numbers that bias, spread and most change
  std::vector<std::size_t> rows{};  // [p] of the fit's table that the bias is about
  /// [p] change of each value if this were taken into account; empty: no change
  Eigen::VectorXd bias{};
  Eigen::MatrixXd spread{};  // [p x k] S, the bias' covariance is S S^T; empty: 0
  /// [p] the largest possible error of each parameter: no figure is widened by more than all of them together; empty: no limit.
  Eigen::VectorXd most{};
  std::vector<std::size_t> without_interval{};  // rows of the table that get none
  std::vector<std::size_t> without_speed{};  // of the friction at speeds, those that are left out
  double size =
      0;  // how far off an assumption was taken to be, N.m or N, where it has no fixed size
  Status status = Status::ok;      // of one that refuses
  std::optional<Remedy> remedy{};  // the remedy for the finding
  std::string sentence{};          // empty: nothing is said
  SentenceIn sentence_in = SentenceIn::warning;

  /// Adds a row of the table whose value it changes.
  void Add(std::size_t row, double change) {
    rows.push_back(row);
    bias.conservativeResize(std::ssize(rows));
    bias[bias.size() - 1] = change;
  }
  /// The change of a row's value; 0 where there is none.
  double BiasOf(std::size_t row) const {
    const auto at = std::ranges::find(rows, row) - rows.begin();
    return at < std::ssize(rows) ? bias[at] : 0;
  }
};

/// A remark of a fit on itself, which changes nothing.
inline Cause Note(std::string sentence, SentenceIn in = SentenceIn::warning) {
  return {.sentence = std::move(sentence), .sentence_in = in};
}

/// The reason why the numbers of a fit mean nothing, although they are reported.
inline Cause Invalidate(Status status, std::string sentence) {
  return {.action = Action::refuse, .status = status, .sentence = std::move(sentence)};
}

/// Why no number of a fit has an interval: a clause.
inline Cause DropsIntervals(std::string clause) {
  return {.action = Action::drop_intervals,
          .sentence = std::move(clause),
          .sentence_in = SentenceIn::message};
}

/// Whether a list leaves no number an interval.
inline bool DropIntervals(const std::vector<Cause>& causes) {
  return std::ranges::any_of(causes,
                             [](const Cause& one) { return one.action == Action::drop_intervals; });
}

/// Whether a list refuses the answer.
inline bool IsRefused(const std::vector<Cause>& causes) {
  return std::ranges::any_of(causes, [](const Cause& one) { return one.action == Action::refuse; });
}

}  // namespace warmjoint

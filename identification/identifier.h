// What an identifier is, and what it may look at.
#pragma once

#include <warmjoint/prepared_log.h>

#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "identification/fit.h"
#include "identification/options.h"
#include "models/foundation/random_stream.h"

namespace warmjoint {

/// Told what is being tried, for people who wait; may be empty.
using Narrator = std::function<void(const std::string& words)>;

/// Everything an identifier may look at. Refers to the log's samples, which must outlive it.
class IdentifierInput {
 public:
  IdentifierInput(PreparedLog given, const Options& given_options, StartKey key,
                  Narrator listener = {})
      : IdentifierInput(given, given.constant_speed().measurements,
                        given.constant_speed().selection, given_options, key, std::move(listener)) {
  }

  /// Tells what is being tried, where someone listens.
  void Tell(const std::string& words) const {
    if (narrator) narrator(words);
  }

  /// The same log with other samples taking part. `other` must outlive the answer.
  IdentifierInput With(const Selection& other) const {
    return {log, measurements, other, options, start, narrator};
  }

  /// The same samples with other options.
  IdentifierInput With(const Options& other) const {
    return {log, measurements, selection, other, start, narrator};
  }

  /// The same log through another view of it, which must outlive the answer.
  IdentifierInput On(const LogView& view) const {
    return {log, view.measurements, view.selection, options, start, narrator};
  }

  /// The log as it was taken, for fits that follow changes of speed.
  IdentifierInput AsTaken() const {
    return {log, log.raw().measurements, log.raw().selection, options, start, narrator};
  }

  const PreparedLog log;
  const Measurements& measurements;
  const Selection& selection;  // filter over all samples, fit on those kept
  const Options options;
  const StartKey start;  // for identifiers that draw their start
  const Narrator narrator;

 private:
  IdentifierInput(PreparedLog of, const Measurements& samples, const Selection& kept,
                  const Options& given_options, StartKey key, Narrator listener)
      : log(std::move(of)),
        measurements(samples),
        selection(kept),
        options(given_options),
        start(key),
        narrator(std::move(listener)) {}
};

/// The motion that an identifier learns from, and with it how a log must reach it.
enum class Regime {
  /// Sliding at constant speeds, tau = G + F, Eq. (6): PreparedLog::steady.
  steady,
  /// Changes of speed too, tau = M a + G + F, Eq. (5): PreparedLog::taken, whose acceleration is
  /// followed from sample to sample.
  transient,
};

struct Identifier {
  std::string name;
  std::string summary;
  Options options;  // at their defaults
  /// Mathematics that fails gives a refusal, a status and a sentence; it does not throw.
  Fit (*fit)(const IdentifierInput& input);
  Regime regime = Regime::steady;
  std::string earlier_name{};  // by which it is still found; or empty

  /// Whether that is its name, or was.
  bool IsCalled(std::string_view asked) const {
    return asked == name || (!asked.empty() && asked == earlier_name);
  }
};

}  // namespace warmjoint

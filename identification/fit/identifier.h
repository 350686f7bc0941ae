// An identifier, and the data that it may use.
#pragma once

#include <warmjoint/prepared_log.h>

#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "identification/fit/fit.h"
#include "identification/options.h"
#include "models/foundation/random_stream.h"

namespace warmjoint {

/// Is called with what is being tried, for people who wait; may be empty.
using Narrator = std::function<void(const std::string& words)>;

/// The form in which a fit gets a log, and which of its samples.
enum class View {
  constant_speed,  // PreparedLog::constant_speed: sliding at constant speeds, tau = G + F, Eq. (6)
  raw,  // PreparedLog::raw: changes of speed too, tau = M a + G + F, Eq. (5), from sample to sample
  moving,  // PreparedLog::moving: all samples at which the joint clearly moves, with its acceleration, Eq. (5)
};

/// The samples of a log as a view shows them; those of `moving` are made when they are first asked for.
const LogView& SeenThrough(View view, const PreparedLog& log);

/// Everything that an identifier may use. Refers to the log's samples, which must outlive it.
class IdentifierInput {
 public:
  IdentifierInput(PreparedLog given, const Options& given_options, StartKey key,
                  Narrator listener = {})
      : IdentifierInput(given, View::constant_speed, given.constant_speed(), given_options, key,
                        std::move(listener)) {}

  /// Reports what is being tried, where there is a listener.
  void Tell(const std::string& words) const {
    if (narrator) narrator(words);
  }

  /// The same log with other samples taking part. `other` must outlive the answer.
  IdentifierInput With(const Selection& other) const {
    return {log, view, measurements, other, options, start, narrator};
  }

  /// The same samples with other options.
  IdentifierInput With(const Options& other) const {
    return {log, view, measurements, selection, other, start, narrator};
  }

  /// The same log through another view of it.
  IdentifierInput Through(View other) const {
    return {log, other, SeenThrough(other, log), options, start, narrator};
  }

  /// Other rows made of the same view, which must outlive the answer.
  IdentifierInput On(const LogView& rows) const {
    return {log, view, rows, options, start, narrator};
  }

  const PreparedLog log;
  const View view;
  const LogSamples& measurements;
  const Selection& selection;  // filter over all samples, fit on those kept
  const Options options;
  const StartKey start;  // for identifiers that draw their start
  const Narrator narrator;

 private:
  IdentifierInput(PreparedLog of, View through, const LogView& seen, const Options& given_options,
                  StartKey key, Narrator listener)
      : IdentifierInput(std::move(of), through, seen.measurements, seen.selection, given_options,
                        key, std::move(listener)) {}
  IdentifierInput(PreparedLog of, View through, const LogSamples& samples, const Selection& kept,
                  const Options& given_options, StartKey key, Narrator listener)
      : log(std::move(of)),
        view(through),
        measurements(samples),
        selection(kept),
        options(given_options),
        start(key),
        narrator(std::move(listener)) {}
};

struct Identifier {
  std::string name;
  std::string summary;
  Options options;  // at their defaults
  /// Mathematics that fails gives a refusal, a status and a sentence; it does not throw. Of the list (identifier_list.h): the
  /// law keeps its physical bounds (inference/bounds.h).
  std::function<Fit(const IdentifierInput& input)> fit;
  /// The view to which it is fitted, unless its option `motion` asks for another.
  View view = View::constant_speed;
  std::string earlier_name{};  // by which it is still found; or empty

  /// Whether that is its name, or was.
  bool IsCalled(std::string_view asked) const {
    return asked == name || (!asked.empty() && asked == earlier_name);
  }
};

}  // namespace warmjoint

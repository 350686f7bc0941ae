// The family of identifiers, and its one list.
#pragma once

#include <string>
#include <vector>

#include "identification/estimate.h"
#include "identification/options.h"
#include "models/foundation/random_stream.h"
#include "models/recording/measurements.h"
#include "models/recording/selection.h"

namespace warmjoint::inline identification {

/// Everything an identifier may look at.
struct IdentifierInput {
  const Measurements& measurements;
  const Selection& selection;  // filter over all samples, fit on those kept
  const Options& options;
  RandomKey random;  // for identifiers that draw their start
};

/// The motion that an identifier learns from, and with it how a log must reach it.
enum class Regime {
  /// Sliding at constant speeds, tau = G + F, Eq. (6). Speed switches between two samples of a slow
  /// log; such a log is split there first, so that no sample's way or loss is charged to two
  /// speeds.
  steady,
  /// Changes of speed too, tau = M a + G + F, Eq. (5): the acceleration is followed from sample to
  /// sample, so that the log stays as it was taken.
  transient,
};

struct Identifier {
  std::string name;
  std::string summary;
  std::vector<OptionInfo> options;
  /// Mathematics that fails gives a status and a sentence; it does not throw.
  Estimate (*identify)(const IdentifierInput& input);
  Regime regime = Regime::steady;
};

/// All identifiers: a new one is its own file pair in identifiers/ and one line in its
/// identifier_list.cc.
const std::vector<Identifier>& Identifiers();

/// The identifier of that name. Throws BadInput with the nearest name.
const Identifier& FindIdentifier(const std::string& name);

}  // namespace warmjoint::inline identification

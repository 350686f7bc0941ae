// Which identifiers a run takes, made ready to run.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>
#include <warmjoint/suite.h>

#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "models/foundation/bad_input.h"
#include "models/foundation/random_stream.h"
#include "scenarios/suite.h"
#include "tools/suite/sandbox.h"

namespace warmjoint {

/// An identifier that gave no answer: `status` says how (crashed, timeout, ...), what() why.
class NoAnswer : public std::runtime_error {
 public:
  NoAnswer(std::string how, const std::string& why)
      : std::runtime_error(why), status(std::move(how)) {}
  std::string status;
};

/// An identifier with its name looked up and its options checked. Safe to call from many threads.
using PreparedIdentifier = std::function<Estimate(const PreparedLog&, StartKey)>;

/// The suite's identifiers whose label or name is among `names`, in the order of `names`; all of them
/// where each name begins with '+' or there is none. +NAME adds to them. A name that the suite lacks is
/// taken from the list of identifiers with its default options; name=command becomes an external
/// one. Throws BadInput for a name that neither has, and for a command under a label that is taken.
std::vector<SuiteIdentifier> ChooseIdentifiers(const std::vector<SuiteIdentifier>& suite,
                                               const std::vector<std::string>& names);

/// The identifiers in their order; functions: of those whose label they have. Throws BadInput from `place` for unknown names and
/// options.
std::vector<PreparedIdentifier> PrepareIdentifiers(
    const std::vector<SuiteIdentifier>& identifiers, const Place& place,
    Confinement confinement = Confinement::sandbox,
    const std::map<std::string, AnswerFunction>& functions = {});

}  // namespace warmjoint

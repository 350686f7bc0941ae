// Which identifiers or compensators a run takes, made ready to run.
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
#include "tools/compensate/arms/arm_list.h"
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

/// A compensator with its name looked up and its options checked: friction along today's log, [N] N.m or N. Safe to call from many
/// threads.
struct PreparedCompensator {
  std::string label;
  CompensatorArm arm;  // with its options
};

/// Who answers in a run: one of the two kinds.
struct Contestants {
  std::vector<PreparedIdentifier> identifiers;
  std::vector<PreparedCompensator> compensators;

  Contestants() = default;
  Contestants(std::vector<PreparedIdentifier> all) : identifiers(std::move(all)) {}  // NOLINT
  std::size_t size() const { return identifiers.size() + compensators.size(); }
};

/// The suite's identifiers whose label or name is among `names`, in the order of `names`; all of them
/// where each name begins with '+' or there is none. +NAME adds to them. A name that the suite lacks is
/// taken from the list of identifiers with its default options; name=command becomes an external
/// one. Of compensators the same without commands. Throws BadInput for a name that neither has, and for a command under a label
/// that is taken.
std::vector<SuiteIdentifier> ChooseIdentifiers(const std::vector<SuiteIdentifier>& suite,
                                               const std::vector<std::string>& names,
                                               Contest contest = Contest::identifiers);

/// The identifiers in their order; functions: of those whose label they have. Throws BadInput from `place` for unknown names and
/// options.
std::vector<PreparedIdentifier> PrepareIdentifiers(
    const std::vector<SuiteIdentifier>& identifiers, const Place& place,
    Confinement confinement = Confinement::sandbox,
    const std::map<std::string, AnswerFunction>& functions = {});

/// Who answers in the suite, of either kind. Throws BadInput as PrepareIdentifiers does.
Contestants PrepareContestants(const Suite& suite, const Place& place,
                               Confinement confinement = Confinement::sandbox,
                               const std::map<std::string, AnswerFunction>& functions = {});

}  // namespace warmjoint

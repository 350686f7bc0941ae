// An identifier of a suite, ready to run.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>

#include <functional>
#include <stdexcept>
#include <string>

#include "models/foundation/random_stream.h"

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

}  // namespace warmjoint

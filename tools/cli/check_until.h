// warmjoint check --until: whether a log is enough, also while it is being recorded.
#pragma once

#include <warmjoint/design.h>
#include <warmjoint/identify.h>
#include <warmjoint/recording.h>

#include <string>

#include "tools/cli/command.h"

namespace warmjoint {

struct UntilArguments {
  std::string goal;  // "friction=5%"
  IdentifySettings identify;
  bool watch = false;  // the recording grows while it is read
};

/// Prints what is known of the goal; done where the interval is there, nothing_trustworthy where it is not. format: text or json. Throws BadInput.
ExitStatus CheckUntil(const UntilArguments& arguments, const RecordingSource& recording,
                      const std::string& format);

}  // namespace warmjoint

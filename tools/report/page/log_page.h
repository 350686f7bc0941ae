// A log and what was identified from it, on one web page.
#pragma once

#include <warmjoint/prepared_log.h>

#include <string>
#include <vector>

#include "tools/report/figures/fit_view.h"

namespace warmjoint::report {

struct LogPage {
  FitView view;  // with the fit, a void one too
  RecordingCheck check;
  std::vector<std::string> commands;  // by which a reader repeats it
};

/// HTML that needs nothing but itself: the verdict, what to do next, parameters, the recording to zoom
/// into, pictures, every test with its answer in plain words, assumptions, the way into MuJoCo, terms.
/// Without scripts the pictures say the same.
std::string MakeLogPage(const LogPage& page);

}  // namespace warmjoint::report

// A log and what was identified from it, for one web page.
#pragma once

#include <warmjoint/prepared_log.h>

#include <string>
#include <vector>

#include "tools/figures/fit_view.h"

namespace warmjoint::figures {

struct LogPage {
  FitView view;  // with the fit, a void one too
  RecordingCheck check;
  std::vector<std::string> commands;  // by which a reader repeats it
};

/// What the template log.html of tools/python/warmjoint shows: verdict, what to do next, parameters, the recording to
/// zoom into, figures, every test with its answer in plain words, assumptions, terms, commands.
/// Long recordings are thinned: of each of 2500 parts, the first, lowest, highest and last sample of each column stay.
Tree LogPageData(const LogPage& page);

}  // namespace warmjoint::figures

// A run on one web page that needs nothing but itself.
#pragma once

#include <string>
#include <vector>

#include "tools/board/leaderboard.h"
#include "tools/report/draw/figure.h"
#include "tools/store/run_description.h"

namespace warmjoint::report {

struct RunPage {
  Leaderboard board;
  RunDescription description;
  std::vector<Figure> figures;
};

/// HTML: question, verdict, leaderboard, pictures, failures, how to repeat it. Pictures are inside
/// it; nothing is asked of any server. The leaderboard's JSON stands in a data block, id "board".
std::string MakeRunPage(const RunPage& page);

}  // namespace warmjoint::report

#include "tools/board/read_board.h"

#include "tools/board/board_builder.h"
#include "tools/store/stored_suite.h"

namespace warmjoint::inline tools {

Leaderboard ReadBoard(const RunStore& store) {
  BoardBuilder builder(StoredSuite(store));
  store.ForEachUnit([&](const std::vector<Result>& unit) { builder.Add(unit); });
  return builder.Finish();
}

}  // namespace warmjoint::inline tools

// Several identifiers on one recording.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/actions/identify_recording.h"

namespace warmjoint::inline tools {

inline constexpr int kComparedBlocks = 6;

/// What one identifier makes of the recording.
struct ComparedIdentifier {
  std::string name;
  Status status = Status::ok;  // of the verdict on all data
  std::string message;
  /// RMSE on blocks that it has not seen, N.m or N: over all of them, and each; none where it gives
  /// no friction without one of them.
  std::optional<double> rmse;
  std::vector<double> blocks;
  double fit = 0;         // on those blocks, 100 (1 - |e| / |y - mean(y)|), %
  double difference = 0;  // mean of the blocks' RMSE less that of the best
  double doubt = 0;       // its standard error over the blocks
};

/// Each on the same blocks of time, in turn held out from fits to the others, in the order given. The
/// differences are paired: the noise of a block is common to all.
std::vector<ComparedIdentifier> CompareIdentifiers(const std::vector<IdentifyTask>& tasks,
                                                   const PreparedLog& log,
                                                   const Narrator& narrator = {});

/// [{identifier, status, message, rmse, fit, difference, difference_std, blocks[]}]
nlohmann::json ComparedToJson(const std::vector<ComparedIdentifier>& compared);

}  // namespace warmjoint::inline tools

// One identifier's results, summed up as they come, so that a run need not be held as a whole.
#pragma once

#include <memory>
#include <vector>

#include "tools/board/leaderboard.h"
#include "tools/board/number_column.h"

namespace warmjoint::inline tools {

/// Root of the mean square of numbers that come one by one; NaN among them are left out.
class MeanSquare {
 public:
  void Add(double value);
  void Add(const MeanSquare& other);
  double Root() const;  // NaN of none

 private:
  double sum_ = 0;
  std::size_t count_ = 0;
};

/// One continuous parameter of the truth.
struct ParameterSums {
  std::string name;
  int intervals = 0;  // 95 % intervals that were given
  int covered = 0;    // of them, those that hold the truth
  bool estimated = false;
  MeanSquare error, bound;
};

/// What a leaderboard needs of one identifier's results, in memory that does not grow with their number.
/// Numbers are NaN where a result lacks them.
class IdentifierColumns {
 public:
  /// file: what holds the columns, for all that are added to each other or compared.
  explicit IdentifierColumns(const std::shared_ptr<NumberFile>& file);

  void Add(const Result& result);
  /// Adds those of another group, which come after these.
  void Add(const IdentifierColumns& other);

  LeaderboardRow SumUp(const SuiteIdentifier& identifier) const;

  /// Continuous NPE of each result; a run without an answer counts as infinitely wrong, so that nobody
  /// wins by answering the easy ones alone.
  const NumberColumn& RankedNpe() const { return ranked_npe_; }

 private:
  NumberColumn npe_continuous_, npe_discrete_, rmse_, fit_, fpe_, mae_, seconds_, ranked_npe_;
  std::map<std::string, int> failures_;
  std::string failure_example_;
  std::vector<ParameterSums> parameters_;
};

}  // namespace warmjoint::inline tools

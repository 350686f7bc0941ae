// The answers of a run one by one, for a table that people search.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/store/run_store.h"

namespace warmjoint::figures {

/// What one identifier made of one realization.
struct ListedAnswer {
  RunUnit unit;
  int identifier = 0;  // position in the suite's list
  std::string status;
  double npe = 0, rmse = 0, fit = 0;  // 0.01 is 1 %; N.m or N; %; NaN without an answer
};

/// All answers of a short run. Of a longer one, realizations 0, n, 2 n, ... of each variant, and the first
/// failures besides.
struct Listing {
  int every = 1;
  std::vector<ListedAnswer> answers;  // in the order of units
};

/// Builds a listing from results as they come.
class ListingBuilder {
 public:
  /// answers: how many the run has when it is finished.
  explicit ListingBuilder(std::int64_t answers);

  void Add(const Result& result);
  Listing Finish() && { return std::move(listing_); }

 private:
  Listing listing_;
  int failures_ = 0;  // listed out of turn
};

}  // namespace warmjoint::figures

#include "tools/figures/run/listing.h"

#include <limits>

#include "tools/figures/run/prime_distance.h"

namespace warmjoint::figures {
namespace {

// what a page holds without becoming slow to open: some 200 bytes each
constexpr std::int64_t kMostListed = 2000;
constexpr int kMostFailures = 500;

}  // namespace

ListingBuilder::ListingBuilder(std::int64_t answers) {
  listing_.every = PrimeDistance(answers, kMostListed);
}

void ListingBuilder::Add(const Result& result) {
  const bool in_turn = result.realization % listing_.every == 0;
  if (!in_turn && (result.status == "ok" || ++failures_ > kMostFailures)) return;
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  listing_.answers.push_back({{result.variant, result.realization},
                              result.identifier,
                              result.status,
                              result.score ? result.score->npe_continuous : unknown,
                              result.metrics ? result.metrics->rmse : unknown,
                              result.metrics ? result.metrics->fit : unknown});
}

}  // namespace warmjoint::figures

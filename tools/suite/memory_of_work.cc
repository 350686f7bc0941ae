#include "tools/suite/memory_of_work.h"

#include <fmt/format.h>

#include <algorithm>

#include "models/foundation/spare_memory.h"

namespace warmjoint::inline tools {
namespace {

/// Bytes for each sample of a recording with its truth, as it is made and written: 230 were measured at four million
/// samples of a CSV file.
constexpr double kSimulated = 230;
/// The same while identifiers fit it: 300 were measured for energy-ml, which keeps no matrix of kernels.
constexpr double kIdentified = 300;
/// Bytes for each result: what a run keeps of each while it goes on is that it is finished. Exports and boards read
/// results one realization at a time.
constexpr double kResult = 100;

double Samples(const Scenario& scenario) { return scenario.duration * scenario.sampling.rate; }

std::string SamplesInWords(const Scenario& scenario) {
  return fmt::format("{:g} samples (duration {:g} s at sampling.rate {:g} Hz)", Samples(scenario),
                     scenario.duration, scenario.sampling.rate);
}

}  // namespace

void RequireMemoryFor(const Scenario& scenario, const std::string& file) {
  RequireMemory(kSimulated * Samples(scenario), SamplesInWords(scenario),
                "shorten duration or lower sampling.rate", {file});
}

void RequireMemoryFor(const Suite& suite, const Shard& shard, int jobs, const std::string& file) {
  // the recordings in hand: the largest variant's on every thread
  Scenario largest = suite.scenario;
  for (int i = 0; i < suite.variants(); ++i) {
    const Scenario variant = VariantScenario(suite, i);
    if (Samples(variant) > Samples(largest)) largest = variant;
  }
  // as many units at once as there are threads, or fewer where there is less to do
  const int realizations = shard.End(suite.realizations) - shard.First(suite.realizations);
  const double units = static_cast<double>(realizations) * suite.variants();
  const double at_once = std::clamp(static_cast<double>(jobs), 1.0, std::max(1.0, units));
  RequireMemory(
      at_once * kIdentified * Samples(largest),
      fmt::format("{:g} recordings at once (--jobs), each of {}", at_once, SamplesInWords(largest)),
      "give fewer --jobs, shorten duration or lower sampling.rate", {file});

  // what the run keeps of each result of the shard while it goes on
  const auto identifiers = static_cast<double>(suite.identifiers.size());
  RequireMemory(units * identifiers * kResult,
                fmt::format("{:g} results ({} realizations of {} variants by {} identifiers, in {} "
                            "shards)",
                            units * identifiers, suite.realizations, suite.variants(), identifiers,
                            shard.count),
                "give fewer realizations, or more shards", {file});
}

}  // namespace warmjoint::inline tools

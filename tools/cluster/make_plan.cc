#include "tools/cluster/make_plan.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "models/foundation/atomic_file.h"
#include "models/foundation/sha256.h"
#include "tools/suite/run_realization.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

constexpr double kLongEnough = 0.5;  // s

double Seconds(std::chrono::steady_clock::time_point since) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
}

}  // namespace

Probe ProbeSuite(const Suite& suite, const std::vector<PreparedIdentifier>& identifiers) {
  Probe probe;
  // the plants of all variants are built once, as a shard builds them
  std::vector<Bench> benches;
  for (int variant = 0; variant < suite.variants(); ++variant) {
    benches.push_back(MakeBench(VariantScenario(suite, variant)));
  }
  const RecordingKeeper keeper("");
  // wall time of one realization in all variants
  const auto once = [&](int realization) {
    const auto start = std::chrono::steady_clock::now();
    for (int variant = 0; variant < suite.variants(); ++variant) {
      const Unit unit{variant, realization};
      const Bench& bench = benches[static_cast<std::size_t>(variant)];
      probe.following.Add(unit, RunRealization(bench, identifiers, unit, keeper).following);
    }
    return Seconds(start);
  };

  // the first one warms caches
  probe.seconds = once(0);
  if (probe.seconds > kLongEnough) return probe;

  // a short one again and again, for at least half a second
  double sum = 0;
  int count = 0;
  while (sum < kLongEnough) sum += once(count++ % suite.realizations);
  probe.seconds = sum / count;
  return probe;
}

int ShardCount(int realizations, double probe_seconds, int jobs) {
  const double shards = std::ceil(realizations * probe_seconds / jobs / kShardSeconds);
  return static_cast<int>(std::clamp(shards, 1.0, static_cast<double>(std::max(1, realizations))));
}

std::vector<PlannedShard> PartEvenly(int first, int end, int count) {
  std::vector<PlannedShard> shards;
  // edges in 64 bits: i (end - first) may not fit into 32
  const auto edge = [&](std::int64_t i) {
    return first + static_cast<int>(i * (end - first) / count);
  };
  for (int i = 0; i < count; ++i) shards.push_back({edge(i), edge(i + 1)});
  return shards;
}

PinnedFile ThisProgram() {
  const fs::path path = fs::read_symlink("/proc/self/exe");
  return {path, Sha256(ReadWholeFile(path))};
}

PinnedFile ThisPlugin() {
  const fs::path path =
      fs::read_symlink("/proc/self/exe").parent_path() / "libwarmjoint_friction.so";
  if (!fs::exists(path)) return {};
  return {path, Sha256(ReadWholeFile(path))};
}

}  // namespace warmjoint::inline tools

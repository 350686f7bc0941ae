// large_run RUN REALIZATIONS SHARDS OUT: shards OUT/1 .. OUT/SHARDS of a run with that many realizations, whose results
// repeat those of RUN; to measure what large runs take without computing them.
#include <fmt/format.h>

#include <cstdlib>

#include "tools/store/run_store.h"

int main(int argc, char** argv) {
  using namespace warmjoint;
  if (argc != 5) {
    fmt::print(stderr, "usage: large_run RUN REALIZATIONS SHARDS OUT\n");
    return 2;
  }
  const RunStore small = RunStore::OpenToRead(argv[1]);
  const int realizations = std::atoi(argv[2]), shards = std::atoi(argv[3]);
  std::vector<Realization> real;
  small.ForEachResult([&](Result result) {
    const RunUnit unit{result.variant, result.realization};
    result.trace = small.ReadTrace(unit, result.identifier);
    if (real.empty() || real.back().unit != unit) real.push_back({unit, 0.001, {}});
    real.back().results.push_back(std::move(result));
  });

  RunDescription description = small.description();
  const std::string count = "realizations: ";
  const std::size_t at = description.suite_yaml.find(count) + count.size();
  description.suite_yaml.replace(at, description.suite_yaml.find('\n', at) - at,
                                 std::to_string(realizations));
  constexpr int kBatch = 500;
  for (int shard = 0; shard < shards; ++shard) {
    RunStore store =
        RunStore::CreateOrResume(fmt::format("{}/{}", argv[4], shard + 1), description);
    const int end = static_cast<int>(std::int64_t{shard + 1} * realizations / shards);
    int next = static_cast<int>(std::int64_t{shard} * realizations / shards);
    while (next < end) {
      std::vector<Realization> batch;
      for (; next < end && batch.size() < kBatch; ++next) {
        batch.push_back(real[static_cast<std::size_t>(next) % real.size()]);
        batch.back().unit.realization = next;
        for (Result& result : batch.back().results) result.realization = next;
      }
      store.Write(batch);
    }
  }
}

// Overhead of the engine, and what a second core gives: 2000 realizations of Table I.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <numeric>

#include "tests/support/table1.h"
#include "tools/suite/engine.h"
#include "tools/suite/prepare_identifiers.h"

namespace warmjoint {
namespace {

constexpr int kRealizations = 2000;

Suite SuiteWith(const std::string& identifier, int realizations) {
  Suite suite;
  suite.name = "table1";
  suite.question = "What does the engine cost?";
  suite.scenario = test::Table1();
  suite.realizations = realizations;
  suite.identifiers = {{identifier, identifier, {}, std::nullopt}};
  return suite;
}

/// A store in a directory of its own, which goes with it.
class Scratch {
 public:
  explicit Scratch(const Suite& suite) : store_(Make(suite)) {}
  ~Scratch() { std::filesystem::remove_all(store_.directory()); }
  RunStore& store() { return store_; }

 private:
  static RunStore Make(const Suite& suite) {
    static int count = 0;
    const auto name = "warmjoint_bench_" + std::to_string(getpid()) + "_" + std::to_string(count++);
    return RunStore::CreateOrResume(std::filesystem::temp_directory_path() / name, Describe(suite));
  }
  RunStore store_;
};

double Seconds(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double>(time).count();
}

/// An identifier that does nothing: what remains is simulation, storage and the engine.
Estimate Nothing(const PreparedLog&, StartKey) {
  Estimate estimate;
  estimate.status = Status::not_identifiable;
  estimate.message = "does nothing";
  return estimate;
}

/// Wall time to store the same realizations without an engine, s.
double StorageSeconds(const Suite& suite) {
  std::vector<Realization> realizations(static_cast<size_t>(suite.realizations));
  for (int i = 0; i < suite.realizations; ++i) {
    Result result;
    result.realization = i;
    result.status = StatusName(Status::not_identifiable);
    result.message = "does nothing";
    realizations[static_cast<size_t>(i)] = {{0, i}, 0, {result}};
  }
  Scratch scratch(suite);
  const auto start = std::chrono::steady_clock::now();
  scratch.store().Write(realizations);
  return Seconds(std::chrono::steady_clock::now() - start);
}

/// us: engine: wall time of a realization besides simulation and storage; simulation: of the plant.
void Overhead(benchmark::State& state) {
  const Suite suite = SuiteWith("nominal-ls", kRealizations);
  const double storage = StorageSeconds(suite);
  for (auto _ : state) {
    Scratch scratch(suite);
    const auto start = std::chrono::steady_clock::now();
    RunSuite(suite, std::vector<PreparedIdentifier>{Nothing}, {}, scratch.store());
    const double wall = Seconds(std::chrono::steady_clock::now() - start);
    SQLite::Statement sum(scratch.store().database(), "SELECT total(seconds) FROM realization");
    sum.executeStep();
    const double simulation = sum.getColumn(0).getDouble();
    state.counters["engine_us"] = 1e6 * (wall - simulation - storage) / kRealizations;
    state.counters["simulation_us"] = 1e6 * simulation / kRealizations;
    state.counters["storage_us"] = 1e6 * storage / kRealizations;
  }
}
BENCHMARK(Overhead)->Unit(benchmark::kMillisecond)->Iterations(3);

double RunSeconds(const Suite& suite, int jobs) {
  Scratch scratch(suite);
  const auto prepared = PrepareIdentifiers(suite.identifiers, {"bench"});
  RunOptions options;
  options.jobs = jobs;
  const auto start = std::chrono::steady_clock::now();
  RunSuite(suite, prepared, options, scratch.store());
  return Seconds(std::chrono::steady_clock::now() - start);
}

/// Ratio of the wall times on one and on two threads, taken in turn.
void TwoCores(benchmark::State& state) {
  const Suite suite = SuiteWith("energy-als", 300);
  for (auto _ : state) {
    const double one = RunSeconds(suite, 1);
    state.counters["one_over_two"] = one / RunSeconds(suite, 2);
  }
}
BENCHMARK(TwoCores)->Unit(benchmark::kMillisecond)->Iterations(3);

}  // namespace
}  // namespace warmjoint

#include "tools/store/run_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

RunDescription TwoIdentifiers() {
  return {
      "name: little\nscenario:\n  seed: 7\n", {"first", "second"}, {}, {{"warmjoint", "0.1.0"}}};
}

Result ScoredResult(int realization) {
  Result result;
  result.realization = realization;
  result.status = "ok";
  result.message = "fine, \"quoted\"";
  result.metrics = Metrics{3600, 4, 4.0, 0.1 + realization, 0.4, 95.5, 0.26};
  result.score = Score{{{"viscous", 5, 5.1, true, true, 0.05}, {"coulomb", 15, 0, false, {}, NAN}},
                       {{"thermal_pole", 0.9, 0.8, true, false, 0.01}},
                       0.011,
                       0.012,
                       0.013,
                       0.014};
  result.trace = {{"iteration", "rmse"}, {0, 1.5f, 1, 0.5f}};
  result.seconds = 0.25;
  return result;
}

Realization TwoResults(int index) {
  Result failed;
  failed.realization = index;
  failed.identifier = 1;
  failed.status = "not_converged";
  failed.message = "took too long";
  return {{0, index}, 0.5, {ScoredResult(index), failed}};
}

TEST(RunStore, ReadsBackWhatWasWritten) {
  const ScratchDirectory scratch;
  {
    RunStore store = RunStore::CreateOrResume(scratch.path() / "run", TwoIdentifiers());
    store.Write(std::vector{TwoResults(3), TwoResults(1)});
  }
  const RunStore store = RunStore::OpenToRead(scratch.path() / "run");
  EXPECT_EQ(store.ReadDescription().identifiers, TwoIdentifiers().identifiers);
  EXPECT_EQ(store.ReadDescription().suite_yaml, TwoIdentifiers().suite_yaml);
  EXPECT_THAT(store.Finished(), ElementsAre(Unit{0, 1}, Unit{0, 3}));

  // rows come in the order of (realization, identifier), numbers bit for bit
  const std::vector<Result> results = store.ReadResults();
  ASSERT_EQ(results.size(), 4u);
  EXPECT_EQ(results[0].realization, 1);
  EXPECT_EQ(results[2].realization, 3);
  const Result& result = results[2];
  EXPECT_EQ(result.message, "fine, \"quoted\"");
  EXPECT_EQ(result.metrics->rmse, 0.1 + 3);
  EXPECT_EQ(result.score->bound_npe_discrete, 0.014);
  ASSERT_EQ(result.score->continuous.size(), 2u);
  EXPECT_EQ(result.score->continuous[0].covered, std::optional(true));
  EXPECT_FALSE(result.score->continuous[1].covered);
  EXPECT_TRUE(std::isnan(result.score->continuous[1].bound));
  EXPECT_EQ(result.score->discrete[0].estimate, 0.8);
  EXPECT_EQ(result.seconds, 0.25);

  // a failure has a message and no numbers
  EXPECT_EQ(results[3].status, "not_converged");
  EXPECT_EQ(results[3].message, "took too long");
  EXPECT_FALSE(results[3].score);
  EXPECT_FALSE(results[3].metrics);
}

TEST(RunStore, KeepsTracesRowByRow) {
  const ScratchDirectory scratch;
  RunStore store = RunStore::CreateOrResume(scratch.path() / "run", TwoIdentifiers());
  store.Write(std::vector{TwoResults(0)});
  const TraceTable trace = store.ReadTrace({0, 0}, 0);
  EXPECT_THAT(trace.columns, ElementsAre("iteration", "rmse"));
  EXPECT_THAT(trace.values, ElementsAre(0, 1.5f, 1, 0.5f));
  EXPECT_EQ(trace.rows(), 2u);
  EXPECT_EQ(store.ReadTrace({0, 0}, 1).rows(), 0u);
}

TEST(RunStore, ABatchIsInAsAWholeOrNotAtAll) {
  const ScratchDirectory scratch;
  RunStore store = RunStore::CreateOrResume(scratch.path() / "run", TwoIdentifiers());
  store.Write(std::vector{TwoResults(0)});
  EXPECT_ANY_THROW(store.Write(std::vector{TwoResults(1), TwoResults(0)}));
  EXPECT_THAT(store.Finished(), ElementsAre(Unit{0, 0}));
  EXPECT_EQ(store.ReadResults().size(), 2u);
}

TEST(RunStore, GoesOnWithTheSameRunAlone) {
  const ScratchDirectory scratch;
  const auto open = [&](const RunDescription& description) {
    RunStore::CreateOrResume(scratch.path() / "run", description);
  };
  open(TwoIdentifiers());
  EXPECT_NO_THROW(open(TwoIdentifiers()));

  RunDescription other = TwoIdentifiers();
  other.suite_yaml = "name: little\nscenario:\n  seed: 8\n";
  EXPECT_THAT([&] { open(other); },
              ThrowsMessage<BadInput>(HasSubstr("scenario.seed: 7 in the directory, 8 asked")));
  other = TwoIdentifiers();
  other.versions = {{"warmjoint", "0.2.0"}};
  EXPECT_THAT([&] { open(other); }, ThrowsMessage<BadInput>(HasSubstr("warmjoint 0.1.0")));
}

TEST(RunStore, RefusesAnOlderSchema) {
  const ScratchDirectory scratch;
  RunStore::CreateOrResume(scratch.path() / "run", TwoIdentifiers());
  SQLite::Database(scratch.path() / "run/results.sqlite", SQLite::OPEN_READWRITE)
      .exec("PRAGMA user_version = 0");
  const auto message = ThrowsMessage<BadInput>(HasSubstr("schema version 0"));
  EXPECT_THAT([&] { RunStore::OpenToRead(scratch.path() / "run"); }, message);
  EXPECT_THAT([&] { RunStore::CreateOrResume(scratch.path() / "run", TwoIdentifiers()); }, message);
}

TEST(RunStore, RefusesWhatIsNoRunDirectory) {
  const ScratchDirectory scratch;
  std::ofstream(scratch.path() / "notes.txt") << "mine";
  EXPECT_THAT([&] { RunStore::CreateOrResume(scratch.path(), TwoIdentifiers()); },
              ThrowsMessage<BadInput>(HasSubstr("holds 'notes.txt'")));
  EXPECT_THAT([&] { RunStore::OpenToRead(scratch.path()); },
              ThrowsMessage<BadInput>(HasSubstr("is no run directory")));

  std::ofstream(scratch.path() / "results.sqlite") << std::string(4096, 'x');
  EXPECT_THAT([&] { RunStore::OpenToRead(scratch.path()); },
              ThrowsMessage<BadInput>(HasSubstr("cannot be opened as a database")));
}

TEST(RunStore, RefusesASecondWriter) {
  const ScratchDirectory scratch;
  const RunStore store = RunStore::CreateOrResume(scratch.path() / "run", TwoIdentifiers());
  EXPECT_THAT([&] { RunStore::CreateOrResume(scratch.path() / "run", TwoIdentifiers()); },
              ThrowsMessage<BadInput>(HasSubstr("another run is writing to it")));
  EXPECT_NO_THROW(RunStore::OpenToRead(scratch.path() / "run"));
}

std::string BytesOf(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(RunStore, SettledResultsAreEqualBytesInWhateverOrderTheyCame) {
  const ScratchDirectory scratch;
  const auto settled = [&](const char* name, const std::vector<std::vector<int>>& batches) {
    RunStore store = RunStore::CreateOrResume(scratch.path() / name, TwoIdentifiers());
    for (const std::vector<int>& batch : batches) {
      std::vector<Realization> realizations;
      for (const int index : batch) realizations.push_back(TwoResults(index));
      store.Write(realizations);
    }
    store.Settle();
    return BytesOf(store.results_file());
  };
  const std::string in_order = settled("one", {{0, 1, 2, 3}});
  EXPECT_EQ(settled("two", {{3}, {0, 2}, {1}}), in_order);
  EXPECT_EQ(settled("two", {}), in_order) << "settled twice";
  EXPECT_EQ(RunStore::OpenToRead(scratch.path() / "two").ReadResults().size(), 8u);
}

TEST(RunStore, GoesOnAfterItWasSettled) {
  const ScratchDirectory scratch;
  RunStore store = RunStore::CreateOrResume(scratch.path() / "run", TwoIdentifiers());
  store.Write(std::vector{TwoResults(0)});
  store.Settle();
  store.Write(std::vector{TwoResults(1)});
  EXPECT_EQ(store.ReadResults().size(), 4u);
}

TEST(RunStore, ReadingWritesNothing) {
  const ScratchDirectory scratch;
  RunStore::CreateOrResume(scratch.path() / "run", TwoIdentifiers())
      .Write(std::vector{TwoResults(0)});
  std::filesystem::remove(scratch.path() / "run/timings.sqlite");
  std::filesystem::remove(scratch.path() / "run/.lock");
  const std::string before = BytesOf(scratch.path() / "run/results.sqlite");
  const RunStore store = RunStore::OpenToRead(scratch.path() / "run");
  EXPECT_TRUE(std::isnan(store.ReadResults()[0].seconds));
  EXPECT_TRUE(store.ReadSimulationSeconds().empty());
  EXPECT_EQ(BytesOf(scratch.path() / "run/results.sqlite"), before);
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "run/timings.sqlite"));
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "run/.lock"));
}

TEST(RunStore, RemovesWhatAKilledWriterLeft) {
  const ScratchDirectory scratch;
  RunStore::CreateOrResume(scratch.path() / "run", TwoIdentifiers());
  std::ofstream(scratch.path() / "run/.warmjoint.part.a1B2c3.sqlite") << "half";
  RunStore::CreateOrResume(scratch.path() / "run", TwoIdentifiers());
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "run/.warmjoint.part.a1B2c3.sqlite"));
}

/// A change that someone made to a finished run, and what tells it.
struct Tampering {
  const char* name;
  const char* sql;
  const char* told;
};

class TamperedStore : public testing::TestWithParam<Tampering> {};

TEST_P(TamperedStore, IsRefused) {
  const ScratchDirectory scratch;
  const auto directory = scratch.path() / "run";
  RunStore::CreateOrResume(directory, TwoIdentifiers())
      .Write(std::vector{TwoResults(0), TwoResults(1)});
  SQLite::Database(directory / "results.sqlite", SQLite::OPEN_READWRITE).exec(GetParam().sql);
  const auto read = [&] {
    const RunStore store = RunStore::OpenToRead(directory);
    for (const Result& result : store.ReadResults()) {
      store.ReadTrace({result.variant, result.realization}, result.identifier);
    }
  };
  EXPECT_THAT(read, ThrowsMessage<BadInput>(HasSubstr(GetParam().told)));
}

INSTANTIATE_TEST_SUITE_P(
    RunStore, TamperedStore,
    testing::Values(
        Tampering{"Identifier", "UPDATE result SET identifier = identifier + 1000", "identifier"},
        Tampering{"NegativeIdentifier", "UPDATE trace SET identifier = -1", "identifier"},
        Tampering{"HugeIdentifier", "UPDATE result SET identifier = identifier + 4294967296",
                  "identifier"},
        Tampering{"Variant", "UPDATE result SET variant = 1", "the run has none"},
        Tampering{"Realization", "UPDATE realization SET realization = realization - 9",
                  "the run has none"},
        Tampering{"NoIdentifiers", "DELETE FROM identifier", "identifier"},
        Tampering{"Gap", "UPDATE identifier SET position = position * 2", "gaps"},
        Tampering{"Renamed", "UPDATE identifier SET label = label || 'x'", "digest"},
        Tampering{"Plan", "UPDATE suite SET yaml = yaml || '#'", "digest"},
        Tampering{"Estimates", "UPDATE parameter SET estimate = truth", "digest"},
        Tampering{"Status", "UPDATE result SET status = 'ok'", "digest"},
        Tampering{"LessParameters", "DELETE FROM parameter WHERE realization = 1", "digest"},
        Tampering{"LessResults", "DELETE FROM result WHERE identifier = 1", "digest"},
        Tampering{"NoResults", "DELETE FROM result", "digest"},
        Tampering{"Orphans", "DELETE FROM realization WHERE realization = 1", "finished"},
        Tampering{"Trace", "UPDATE trace SET float32 = zeroblob(length(float32))", "digest"},
        Tampering{"Columns", "UPDATE trace SET columns = 'rmse'", "digest"},
        Tampering{"View", "CREATE VIEW more AS SELECT 1", "foreign 'view more"},
        Tampering{"Trigger",
                  "CREATE TRIGGER act AFTER INSERT ON result BEGIN DELETE FROM suite; END",
                  "foreign 'trigger act"},
        Tampering{"ViewForTable",
                  "DROP TABLE trace; CREATE VIEW trace AS WITH RECURSIVE n(i) AS (SELECT 1 UNION"
                  " ALL SELECT i + 1 FROM n) SELECT * FROM n",
                  "foreign 'view trace"},
        Tampering{"Column", "ALTER TABLE result ADD COLUMN more TEXT", "foreign 'table result"},
        Tampering{"NoTable", "DROP TABLE trace", "lacks some of its tables"},
        Tampering{"WriteAhead", "PRAGMA journal_mode = WAL", "write-ahead mode"}),
    [](const auto& tampering) { return tampering.param.name; });

TEST(RunStore, StartsAnewWhereNothingWasStoredYet) {
  const ScratchDirectory scratch;
  std::filesystem::create_directory(scratch.path() / "run");
  std::ofstream(scratch.path() / "run/.lock");
  std::ofstream(scratch.path() / "run/results.sqlite");
  const RunStore store = RunStore::CreateOrResume(scratch.path() / "run", TwoIdentifiers());
  EXPECT_TRUE(store.Finished().empty());
  EXPECT_TRUE(store.ReadResults().empty());
  EXPECT_EQ(store.ReadDescription().identifiers.size(), TwoIdentifiers().identifiers.size());
  EXPECT_TRUE(RunStore::OpenToRead(scratch.path() / "run").ReadResults().empty());
}

TEST(RunStore, GathersOverlapsOnlyWhereTheirTracesAgreeToo) {
  const ScratchDirectory scratch;
  const auto shard = [&](const char* name, float rmse) {
    Realization one = TwoResults(1);
    one.results[0].trace = {{"iteration", "rmse"}, {0, 1.5f, 1, rmse}};
    RunStore store = RunStore::CreateOrResume(scratch.path() / name, TwoIdentifiers());
    store.Write(std::vector{one});
    return scratch.path() / name;
  };
  const std::vector shards{shard("one", 0.5f), shard("same", 0.5f), shard("other", 0.25f)};
  const auto gather = [&](const char* name, std::size_t second) {
    RunStore merged = RunStore::CreateOrResume(scratch.path() / name, TwoIdentifiers());
    merged.Gather({shards[0], shards[second]}, Overlap::equal);
  };
  EXPECT_NO_THROW(gather("alike", 1));
  EXPECT_THAT([&] { gather("apart", 2); },
              ThrowsMessage<BadInput>(HasSubstr("holds other results of realization 1")));
}

}  // namespace
}  // namespace warmjoint

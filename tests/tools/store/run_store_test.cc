#include "tools/store/run_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "tests/tools/scratch_directory.h"
#include "tests/tools/store/little_suite.h"
#include "tools/store/export_csv.h"

namespace warmjoint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

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

std::vector<Result> ResultsOf(const RunStore& store) {
  std::vector<Result> results;
  store.ForEachResult([&](Result result) { results.push_back(std::move(result)); });
  return results;
}

class RunStoreTest : public testing::Test {
 protected:
  RunStore Make(const char* name, const std::vector<int>& realizations) const {
    RunStore store = RunStore::CreateOrResume(Path(name), LittleRun());
    std::vector<Realization> batch;
    for (const int index : realizations) batch.push_back(TwoResults(index));
    store.Write(batch);
    return store;
  }
  std::filesystem::path Path(const std::string& name) const { return scratch_.path() / name; }

  const ScratchDirectory scratch_;
};

TEST_F(RunStoreTest, ReadsBackWhatWasWritten) {
  Make("run", {3, 1});
  const RunStore store = RunStore::OpenToRead(Path("run"));
  EXPECT_EQ(store.description().suite_yaml, LittleRun().suite_yaml);
  EXPECT_EQ(store.description().versions, LittleRun().versions);
  EXPECT_EQ(store.suite().identifiers.at(1).label, "b");
  EXPECT_THAT(store.Finished(), ElementsAre(RunUnit{0, 1}, RunUnit{0, 3}));

  // rows come in the order of (realization, identifier), numbers bit for bit
  const std::vector<Result> results = ResultsOf(store);
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
  EXPECT_THAT(store.ReadTrace({0, 3}, 0).columns, ElementsAre("iteration", "rmse"));
  EXPECT_THAT(store.ReadTrace({0, 3}, 0).values, ElementsAre(0, 1.5f, 1, 0.5f));

  // a failure has a message and no numbers
  EXPECT_EQ(results[3].status, "not_converged");
  EXPECT_EQ(results[3].message, "took too long");
  EXPECT_FALSE(results[3].score);
  EXPECT_FALSE(results[3].metrics);
  EXPECT_EQ(store.ReadTrace({0, 3}, 1).rows(), 0u);
}

TEST_F(RunStoreTest, ABatchIsInAsAWholeOrNotAtAll) {
  RunStore store = Make("run", {0});
  EXPECT_ANY_THROW(store.Write(std::vector{TwoResults(1), TwoResults(0)}));
  EXPECT_THAT(store.Finished(), ElementsAre(RunUnit{0, 0}));
  EXPECT_EQ(ResultsOf(store).size(), 2u);
}

TEST_F(RunStoreTest, GoesOnWithTheSameRunAlone) {
  Make("run", {});
  EXPECT_NO_THROW(Make("run", {}));
  RunDescription other = LittleRun();
  other.versions = {{"warmjoint", "0.2.0"}};
  EXPECT_THAT([&] { RunStore::CreateOrResume(Path("run"), other); },
              ThrowsMessage<BadInput>(HasSubstr("warmjoint 0.1.0")));
}

TEST_F(RunStoreTest, RefusesWhatIsNoRunDirectory) {
  WriteWholeFile(Path("notes.txt"), "mine");
  EXPECT_THAT([&] { RunStore::CreateOrResume(scratch_.path(), LittleRun()); },
              ThrowsMessage<BadInput>(HasSubstr("holds 'notes.txt'")));
  EXPECT_THAT([&] { RunStore::OpenToRead(scratch_.path()); },
              ThrowsMessage<BadInput>(HasSubstr("is no run directory")));
}

TEST_F(RunStoreTest, RefusesASecondWriter) {
  const RunStore store = Make("run", {0});
  EXPECT_THAT([&] { Make("run", {}); },
              ThrowsMessage<BadInput>(HasSubstr("another run is writing to it")));
  EXPECT_NO_THROW(RunStore::OpenToRead(Path("run")));
}

TEST_F(RunStoreTest, ReadingWritesNothing) {
  Make("run", {0});
  std::filesystem::remove(Path("run/.lock"));
  const std::string before = ReadWholeFile(Path("run/results.sqlite"));
  EXPECT_EQ(ResultsOf(RunStore::OpenToRead(Path("run"))).size(), 2u);
  EXPECT_EQ(ReadWholeFile(Path("run/results.sqlite")), before);
  EXPECT_FALSE(std::filesystem::exists(Path("run/.lock")));
}

TEST_F(RunStoreTest, RemovesWhatAKilledWriterLeft) {
  Make("run", {});
  WriteWholeFile(Path("run/.warmjoint.part.a1B2c3.sqlite"), "half");
  Make("run", {});
  EXPECT_FALSE(std::filesystem::exists(Path("run/.warmjoint.part.a1B2c3.sqlite")));
}

TEST_F(RunStoreTest, StartsAnewWhereNothingWasStoredYet) {
  std::filesystem::create_directory(Path("run"));
  std::ofstream(Path("run/.lock"));
  std::ofstream(Path("run/results.sqlite"));
  EXPECT_THAT([&] { RunStore::OpenToRead(Path("run")); },
              ThrowsMessage<BadInput>(HasSubstr("holds no results yet")));
  EXPECT_TRUE(Make("run", {}).Finished().empty());
  EXPECT_TRUE(ResultsOf(RunStore::OpenToRead(Path("run"))).empty());
}

TEST_F(RunStoreTest, GathersShards) {
  Make("one", {0, 2});
  Make("two", {3, 1});
  RunStore merged = Make("merged", {});
  merged.Gather({Path("two"), Path("one")});
  EXPECT_EQ(merged.Finished().size(), 4u);
  EXPECT_EQ(ResultsOf(merged)[2].realization, 1);
  EXPECT_THAT(merged.ReadTrace({0, 3}, 0).values, ElementsAre(0, 1.5f, 1, 0.5f));
}

/// A change that makes a store unusable, and what the refusal says of it.
struct Damage {
  const char* sql;
  const char* told;
};

constexpr Damage kDamages[]{
    {"PRAGMA user_version = 2", "schema version 2"},
    {"UPDATE result SET identifier = identifier + 1000", "identifier 1000"},
    {"UPDATE result SET variant = 1", "variant 1"},
    {"UPDATE result SET realization = -9 - realization", "realization -10"},
    {"UPDATE trace SET columns = 'a,b,c'", "do not fill its 3 columns"},
    {"DROP TABLE trace; CREATE VIEW trace AS WITH RECURSIVE n(i) AS (SELECT 1 UNION"
     " ALL SELECT i + 1 FROM n) SELECT * FROM n",
     "cannot be used as a run's database"},
    {"DROP TABLE result", "no such table"}};

TEST_F(RunStoreTest, RefusesADamagedStoreWithThePlace) {
  for (const auto& [sql, told] : kDamages) {
    SCOPED_TRACE(sql);
    std::filesystem::remove_all(Path("run"));
    Make("run", {0, 1});
    SQLite::Database(Path("run/results.sqlite"), SQLite::OPEN_READWRITE).exec(sql);
    const auto read = [&] {
      const RunStore store = RunStore::OpenToRead(Path("run"));
      for (const Result& result : ResultsOf(store)) {
        store.ReadTrace({result.variant, result.realization}, result.identifier);
      }
    };
    EXPECT_THAT(read, ThrowsMessage<BadInput>(
                          testing::AllOf(HasSubstr("results.sqlite: "), HasSubstr(told))));
  }
}

TEST_F(RunStoreTest, RefusesAFileThatIsCutOrNoDatabase) {
  Make("run", {0, 1, 2, 3});
  const std::string whole = ReadWholeFile(Path("run/results.sqlite"));
  std::string zeros = whole;
  zeros.replace(whole.size() / 2, 2048, 2048, '\0');
  for (const std::string& bytes :
       {whole.substr(0, whole.size() / 2), std::string(4096, 'x'), zeros}) {
    WriteWholeFile(Path("run/results.sqlite"), bytes);
    const auto read = [&] { ResultsOf(RunStore::OpenToRead(Path("run"))); };
    EXPECT_THAT(read, ThrowsMessage<BadInput>(testing::AllOf(HasSubstr("results.sqlite: "),
                                                             HasSubstr("run the suite anew"))));
  }
}

std::string ResultsToCsv(const std::vector<Result>& results,
                         const std::vector<std::string>& labels) {
  Suite suite;
  for (const std::string& label : labels) suite.identifiers.push_back({label, label, {}, {}});
  CsvColumns columns;
  for (const Result& result : results) columns.Add(result);
  std::string csv = CsvHeader(columns, suite);
  for (const Result& result : results) csv += CsvRow(result, columns, suite);
  return csv;
}

TEST(ExportCsv, WritesOneRowAResultWithEmptyCellsForTheUnknown) {
  Result scored;
  scored.status = "ok";
  scored.metrics = Metrics{10, 2, 2, 0.1, 0.2, 99, 0.3};
  scored.score = Score{{{"viscous", 5, 5.5, true, true, 0.25}},
                       {{"viscous", 5, 5.5, true, true, 0.25}},
                       0.1,
                       0.1,
                       0.05,
                       NAN};
  Result failed;
  failed.identifier = 1;
  failed.status = "crashed";
  failed.message = "said \"no\", twice";
  EXPECT_EQ(ResultsToCsv({scored, failed}, {"ours", "theirs"}),
            "realization,identifier,status,n,parameters,effective_parameters,rmse,mae,fit,fpe,"
            "npe_continuous,npe_discrete,bound_npe_continuous,bound_npe_discrete,"
            "viscous,viscous_truth,viscous_bound,viscous_covered,message\n"
            "0,ours,ok,10,2,2,0.1,0.2,99,0.3,0.1,0.1,0.05,,5.5,5,0.25,1,\n"
            "0,theirs,crashed,,,,,,,,,,,,,,,,\"said \"\"no\"\", twice\"\n");
}

TEST(ExportCsv, NumbersReadBackBitForBit) {
  Result result;
  result.metrics = Metrics{1, 1, 1, 0.1 + 0.2, 1.0 / 3.0, 5e-324, 1e300};
  const std::string csv = ResultsToCsv({result}, {"one"});
  for (const char* digits : {"0.30000000000000004", "0.3333333333333333", "5e-324", "1e+300"}) {
    EXPECT_NE(csv.find(digits), std::string::npos) << digits << " in " << csv;
  }
}

}  // namespace
}  // namespace warmjoint

// Stores that others changed: SQL statements done to the store of a small run, one a line; or, where the input begins
// as a database does, the whole file.
#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>
#include <stdlib.h>

#include <fstream>

#include "models/foundation/atomic_file.h"
#include "scenarios/suite.h"
#include "tests/fuzz/fuzz.h"
#include "tools/board/leaderboard.h"
#include "tools/store/run_store.h"

namespace {

using namespace warmjoint;
namespace fs = std::filesystem;

constexpr const char* kSuite = R"(name: little
question: Which?
realizations: 3
scenario:
  friction: {law: viscous_coulomb, parameters: {viscous: 5, coulomb: 15}}
  motion: {speeds: [1], hold: 1}
  duration: 60
ladder: {variable: noise.torque, values: [0.1, 0.2]}
identifiers: [{name: nominal-ls}, {name: energy-ml}]
)";

/// A run of two realizations, and room to change it.
class SpoiltRun {
 public:
  SpoiltRun() {
    std::string pattern = fuzz::ScratchFolder() / "warmjoint_fuzz_XXXXXX";
    fuzz::Require(mkdtemp(pattern.data()) != nullptr);
    folder_ = pattern;
    {
      RunStore store = RunStore::CreateOrResume(folder_ / "run", description_);
      store.Write(std::vector{Whole({0, 0}), Whole({1, 2})});
    }
    bytes_ = ReadWholeFile(results());
  }
  ~SpoiltRun() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  fs::path folder() const { return folder_ / "run"; }
  fs::path results() const { return folder() / "results.sqlite"; }
  const std::string& bytes() const { return bytes_; }

 private:
  static Realization Whole(RunUnit unit) {
    Realization whole{unit, 0.5, {}};
    for (int identifier = 0; identifier < 2; ++identifier) {
      Result result;
      result.variant = unit.variant;
      result.realization = unit.realization;
      result.identifier = identifier;
      result.status = "ok";
      result.metrics = Metrics{60, 2, 2.0, 0.1, 0.4, 95.5, 0.26};
      result.score = Score{
          {{"viscous", 5, 5.1, true, true, 0.05}}, {{"pole", 1, 0.8, true, {}, 0.01}}, 1, 2, 3, 4};
      result.trace = {{"iteration", "rmse"}, {0, 1.5f, 1, 0.5f}};
      whole.results.push_back(result);
    }
    return whole;
  }

  fs::path folder_;
  std::string bytes_;
  const RunDescription description_{SuiteToYaml(ParseSuite(kSuite, "little.yaml")),
                                    {{"warmjoint", "0.1.0"}}};
};

/// Lets statements change rows and tables, and nothing outside the file.
int AllowRows(void*, int action, const char*, const char*, const char*, const char*) {
  const bool outside =
      action == SQLITE_ATTACH || action == SQLITE_DETACH || action == SQLITE_PRAGMA;
  return outside ? SQLITE_DENY : SQLITE_OK;
}

/// Does what of the lines is SQL, each for a short time at most.
void Change(const fs::path& file, std::string_view lines) {
  SQLite::Database database(file.string(), SQLite::OPEN_READWRITE);
  sqlite3* handle = database.getHandle();
  database.exec("PRAGMA synchronous = OFF; PRAGMA journal_mode = MEMORY");
  sqlite3_set_authorizer(handle, AllowRows, nullptr);
  sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, 1 << 20);
  int steps = 0;
  const auto enough = [](void* count) { return ++*static_cast<int*>(count) > 100 ? 1 : 0; };
  sqlite3_progress_handler(handle, 1000, enough, &steps);
  while (!lines.empty()) {
    sqlite3_exec(handle, std::string(fuzz::TakeLine(lines)).c_str(), nullptr, nullptr, nullptr);
  }
}

}  // namespace

void warmjoint::fuzz::Read(std::string_view bytes) {
  static const SpoiltRun run;
  for (const char* left : {"-journal", "-wal", "-shm"}) fs::remove(run.results().string() + left);
  const bool whole = bytes.starts_with("SQLite format 3");
  std::ofstream(run.results(), std::ios::binary) << (whole ? bytes : run.bytes());
  if (!whole) Change(run.results(), bytes);

  // everything that a reader asks a store for
  const RunStore store = RunStore::OpenToRead(run.folder());
  const Suite& suite = store.suite();
  store.ForEachResult([&](const Result& result) {
    const RunUnit unit{result.variant, result.realization};
    fuzz::Require(0 <= result.variant && result.variant < suite.variants());
    fuzz::Require(0 <= result.realization && result.realization < suite.realizations);
    fuzz::Require(result.identifier >= 0 &&
                  static_cast<std::size_t>(result.identifier) < suite.identifiers.size());
    const TraceTable trace = store.ReadTrace(unit, result.identifier);
    fuzz::Require(trace.rows() * trace.columns.size() == trace.values.size());
  });
  ReadBoard(store);
}

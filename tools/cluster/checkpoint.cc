#include "tools/cluster/checkpoint.h"

#include <SQLiteCpp/Backup.h>

#include <fstream>
#include <vector>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "tools/store/database.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;

void TakeSnapshot(const fs::path& database, const fs::path& copy) {
  // a copy that another task left half-done must not be added to
  fs::remove(copy);
  Guarded(copy, [&] {
    SQLite::Database to(copy.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    // the copy counts once it is whole, so that it needs no journal on disk
    to.exec("PRAGMA journal_mode = MEMORY; PRAGMA synchronous = OFF");
    constexpr int patience = 10'000;  // ms
    SQLite::Database from(database.string(), SQLite::OPEN_READWRITE, patience);
    // all pages in one step: the copy is of one moment
    SQLite::Backup(to, from).executeStep(-1);
  });
}

Tally TallyOf(const fs::path& results, const PlannedShard& shard) {
  return Guarded(results, [&] {
    // finished realizations of the shard's own range: a store may hold more after a split
    const SQLite::Database database = OpenDatabase(results);
    Tally tally;
    SQLite::Statement count(database,
                            "SELECT count(*) FROM realization WHERE realization >= ? AND"
                            " realization < ?");
    count.bind(1, shard.first);
    count.bind(2, shard.end);
    if (count.executeStep()) tally.finished = count.getColumn(0).getInt();

    // what identifiers failed at, by status
    SQLite::Statement failures(database,
                               "SELECT status, count(*) FROM result WHERE realization >= ? AND"
                               " realization < ? AND status <> 'ok' GROUP BY status");
    failures.bind(1, shard.first);
    failures.bind(2, shard.end);
    while (failures.executeStep()) {
      tally.failures[failures.getColumn(0).getString()] = failures.getColumn(1).getInt();
    }
    return tally;
  });
}

void PutFile(const fs::path& file, const fs::path& target) {
  // in blocks of 1 MiB
  std::ifstream from(file, std::ios::binary);
  if (!from) Refuse({file.string()}, "cannot be read");
  AtomicFile to(target);
  std::vector<char> block(1 << 20);
  while (from.read(block.data(), static_cast<std::streamsize>(block.size())), from.gcount() > 0) {
    to.Write({block.data(), static_cast<std::size_t>(from.gcount())});
  }
  // the target changes its content at once, once all is on disk
  to.Commit();
}

}  // namespace warmjoint::inline tools

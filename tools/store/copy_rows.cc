#include "tools/store/copy_rows.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <array>
#include <memory>
#include <queue>
#include <string>

#include "models/foundation/bad_input.h"
#include "tools/store/open_database.h"

namespace warmjoint::inline tools {
namespace {

constexpr std::size_t kLongestKey = 5;  // columns
using Key = std::array<int, kLongestKey>;

/// A table and how many of its first columns are its key.
struct Table {
  const char* name;
  std::size_t key;
  int digest = -1;  // column in which two rows of one key have to agree; -1: none
};

constexpr std::array<Table, 4> kResultTables{
    {{"realization", 2, 2}, {"result", 3}, {"parameter", 5}, {"trace", 3, 5}}};
constexpr std::array<Table, 2> kTimingTables{{{"identification", 3}, {"simulation", 2}}};

struct Finalize {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Statement = std::unique_ptr<sqlite3_stmt, Finalize>;

/// SQLiteCpp hands no values on from one statement to another, so that this file talks to SQLite itself.
Statement Prepare(SQLite::Database& database, const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  database.check(sqlite3_prepare_v2(database.getHandle(), sql.c_str(), -1, &statement, nullptr));
  return Statement(statement);
}

/// The rows of one table and variant of a source, opened when they are first asked for.
class Cursor {
 public:
  Cursor(const RowSource& source, Unit first, const Table& table)
      : source_(&source), table_(&table), key_{first.variant, first.realization, -1, -1, -1} {}

  const Key& key() const { return key_; }
  const RowSource& source() const { return *source_; }
  bool is_open() const { return rows_ != nullptr; }
  sqlite3_stmt* rows() const { return rows_.get(); }

  /// Goes to the next row, or to the first; false, and closed, after the last.
  bool Step() {
    if (!is_open()) Open();
    // the database is open only while there are rows to read
    const int state = sqlite3_step(rows_.get());
    if (state == SQLITE_DONE) {
      Close();
      return false;
    }
    if (state != SQLITE_ROW) database_->check(state);
    // the key says where the row goes among those of all sources
    for (std::size_t i = 0; i < table_->key; ++i) {
      key_[i] = sqlite3_column_int(rows_.get(), static_cast<int>(i));
    }
    return true;
  }

 private:
  void Open() {
    database_ = std::make_unique<SQLite::Database>(ReopenFrozen(source_->file));
    // rows in the order of their keys
    std::string order = "1";
    for (std::size_t i = 2; i <= table_->key; ++i) order += fmt::format(", {}", i);
    rows_ = Prepare(*database_, fmt::format("SELECT * FROM {} WHERE variant = {} ORDER BY {}",
                                            table_->name, key_[0], order));
  }
  void Close() {
    rows_.reset();
    database_.reset();
  }

  const RowSource* source_;
  const Table* table_;
  Key key_;
  std::unique_ptr<SQLite::Database> database_;
  Statement rows_;
};

/// An insertion of rows with as many columns as `row`.
Statement InsertLike(SQLite::Database& fresh, const Table& table, sqlite3_stmt* row) {
  // as many places as the source has columns, without their names
  const std::vector<std::string> marks(static_cast<std::size_t>(sqlite3_column_count(row)), "?");
  return Prepare(fresh,
                 fmt::format("INSERT INTO {} VALUES ({})", table.name, fmt::join(marks, ", ")));
}

void Insert(SQLite::Database& fresh, sqlite3_stmt* insert, sqlite3_stmt* row) {
  // each value as SQLite has it, of whatever type
  const int columns = sqlite3_column_count(row);
  for (int i = 0; i < columns; ++i) {
    fresh.check(sqlite3_bind_value(insert, i + 1, sqlite3_column_value(row, i)));
  }
  const int state = sqlite3_step(insert);
  if (state != SQLITE_DONE) fresh.check(state);
  sqlite3_reset(insert);
}

std::string TextOf(sqlite3_stmt* row, int column) {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
  return text ? text : "";
}

/// Refuses a second row of one key where each may be there once, or where both differ.
void CheckOverlap(const Cursor& cursor, const Table& table, bool equal, Overlap overlap) {
  const Place place{cursor.source().file.parent_path().string()};
  if (table.digest >= 0 && overlap == Overlap::refused) {
    Refuse(place, "holds realization {}, which another shard holds as well; merge each shard once",
           cursor.key()[1]);
  }
  if (equal) return;
  Refuse(place, "holds other results of realization {} than another shard; run both again",
         cursor.key()[1]);
}

/// One table of all sources: the cursor with the lowest key always goes first.
void CopyTable(SQLite::Database& fresh, const std::vector<RowSource>& sources, const Table& table,
               Overlap overlap) {
  // one cursor for each variant of each source
  std::vector<Cursor> cursors;
  for (const RowSource& source : sources) {
    for (const Unit& first : source.first) cursors.emplace_back(source, first, table);
  }
  // rows are merged in order, so that the file is the same whatever the shards were
  const auto later = [](const Cursor* a, const Cursor* b) { return a->key() > b->key(); };
  std::priority_queue<Cursor*, std::vector<Cursor*>, decltype(later)> queue(later);
  for (Cursor& cursor : cursors) queue.push(&cursor);

  Statement insert;
  Key last{-1, -1, -1, -1, -1};
  std::string digest;
  while (!queue.empty()) {
    Cursor& cursor = *queue.top();
    queue.pop();
    // a new cursor has its place in the queue, but no row yet
    if (cursor.is_open()) {
      if (!insert) insert = InsertLike(fresh, table, cursor.rows());
      const std::string here = table.digest < 0 ? "" : TextOf(cursor.rows(), table.digest);
      // a row that two sources have is written once, where that is allowed
      if (cursor.key() != last) {
        Insert(fresh, insert.get(), cursor.rows());
      } else {
        CheckOverlap(cursor, table, here == digest, overlap);
      }
      last = cursor.key();
      digest = here;
    }
    if (cursor.Step()) queue.push(&cursor);
  }
}

template <typename Tables>
void CopyTables(SQLite::Database& fresh, const std::vector<RowSource>& sources,
                const Tables& tables, Overlap overlap) {
  SQLite::Transaction transaction(fresh);
  for (const Table& table : tables) CopyTable(fresh, sources, table, overlap);
  transaction.commit();
}

}  // namespace

RowSource SourceOf(const std::filesystem::path& file) {
  RowSource source{file, {}};
  const SQLite::Database database = ReopenFrozen(file);
  // the first unit of each variant, where reading begins
  Guarded(file, [&] {
    SQLite::Statement first(database,
                            "SELECT variant, min(realization) FROM realization GROUP BY variant"
                            " ORDER BY variant");
    while (first.executeStep()) {
      source.first.push_back({first.getColumn(0).getInt(), first.getColumn(1).getInt()});
    }
  });
  return source;
}

void CopyResults(SQLite::Database& fresh, const std::vector<RowSource>& sources, Overlap overlap) {
  CopyTables(fresh, sources, kResultTables, overlap);
}

void CopyTimings(SQLite::Database& fresh, const std::vector<RowSource>& sources) {
  CopyTables(fresh, sources, kTimingTables, Overlap::equal);
}

}  // namespace warmjoint::inline tools

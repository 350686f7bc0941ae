#include "tools/cluster/task_folder.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <optional>
#include <thread>

#include "models/foundation/bad_input.h"
#include "tools/store/folders.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kPatience{20};  // with other tasks

/// A folder that belongs to this user and is open to nobody else; one that someone planted is refused.
void MakePrivate(const fs::path& folder) {
  // made or there already: it must be a folder of this user's that is closed to others
  mkdir(folder.c_str(), 0700);
  struct stat status {};
  const bool found = lstat(folder.c_str(), &status) == 0;
  const bool ours =
      found && S_ISDIR(status.st_mode) && status.st_uid == geteuid() && (status.st_mode & 077) == 0;
  if (!ours) {
    Refuse({folder.string()},
           "cannot be made, or is not this user's alone; set TMPDIR to a folder on this machine's "
           "own disk");
  }
}

/// Makes a folder below one that other tasks of the plan may remove at the same moment, as long as it is
/// empty: then both are made again.
void MakeWhole(const fs::path& folder) {
  std::error_code error;
  // until both exist, or something else is wrong
  for (const auto deadline = Clock::now() + kPatience; Clock::now() < deadline;) {
    fs::create_directories(folder, error);
    if (!error) return;
    // only what another task removed meanwhile is worth another try
    if (error != std::errc::no_such_file_or_directory && error != std::errc::file_exists) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  throw fs::filesystem_error("cannot be made", folder, error);
}

/// A killed task's child dies with it, but not at the same moment.
void AwaitStore(const fs::path& store) {
  const auto deadline = Clock::now() + kPatience;
  // a lock that can be had: nobody writes to the store any more
  while (fs::exists(store)) {
    try {
      const DirectoryLock lock(store);
      return;
    } catch (const BadInput&) {
      if (Clock::now() > deadline) throw;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

}  // namespace

TaskFolder::TaskFolder(const Plan& plan, int number) {
  // the same name each time, so that a task that is started again finds it
  const fs::path user = fs::temp_directory_path() / fmt::format("warmjoint-{}", geteuid());
  path_ = user / plan.id / std::to_string(number);
  MakePrivate(user);
  MakeWhole(path_);
  AwaitStore(store());
}

bool TaskFolder::HasStore() const { return fs::exists(store() / "suite.yaml"); }

void TaskFolder::FetchStore(const fs::path& shard_folder) const {
  fs::remove_all(store());
  // a shard without results begins anew
  if (!fs::exists(shard_folder / "results.sqlite")) return;
  fs::create_directories(store());

  // the results without the suite, which the child writes
  fs::copy_file(shard_folder / "results.sqlite", store() / "results.sqlite");
}

void TaskFolder::Remove() const {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  fs::remove(path_.parent_path(), ignored);  // where it was the plan's last here
}

}  // namespace warmjoint::inline tools

// Suites: many realizations, several identifiers, one leaderboard. What `warmjoint run` and `warmjoint compare` do.
//
//   RunSuite("table1.yaml", "RUN", {.realizations = 50});
//   std::puts(FormatLeaderboard("RUN", "text").c_str());
#pragma once

#include <warmjoint/recording.h>

#include <cstdint>
#include <functional>
#include <utility>

namespace warmjoint::api {

/// What changes of a suite, and how it is run.
struct RunSettings {
  std::optional<int> jobs{};               // threads, 1 to 1024; one for each core where not given
  std::optional<int> realizations{};       // instead of the suite's, at least 1
  std::optional<std::uint64_t> seed{};     // instead of the suite's
  std::vector<std::string> identifiers{};  // only these; empty: the suite's
  bool allow_commands = false;             // run the commands that the suite names as identifiers
  bool unconfined = false;                 // run them without a sandbox
  bool keep_recordings = false;            // HDF5 files into DIRECTORY/recordings
  std::function<void(int finished, int total)>
      watch{};  // is told of progress; what it throws ends the run, resumably
};

/// How a run ended.
struct RunSummary {
  int realizations = 0;  // of all variants that are in the store
  std::size_t results = 0;
  std::size_t failed = 0;  // results that are not ok
  std::vector<std::pair<std::string, std::string>>
      silent{};  // identifiers that never answered, with the first message
  std::string
      not_following{};  // of joints that did not follow their motion in this call: how many, and what cures it
};

/// Runs a suite into a directory, or goes on where an earlier run stopped. Results are those of `warmjoint run`,
/// bit for bit on one kind of machine. Throws BadInput and OutputFailed.
RunSummary RunSuite(const std::filesystem::path& suite, const std::filesystem::path& directory,
                    const RunSettings& settings = {});

/// Median, quartiles and root mean square over realizations; NaN of none.
struct Summary {
  double median = 0, q25 = 0, q75 = 0, rms = 0;
};

/// One parameter over all realizations.
struct ParameterRow {
  std::string name;
  std::optional<double> coverage95{};  // share of intervals that hold the truth
  double efficiency = 0;               // rms error / rms Cramer-Rao bound; NaN where unknown
};

/// One identifier over all realizations.
struct LeaderboardRow {
  std::string identifier;
  int runs = 0;
  std::map<std::string, int> failures{};  // by status
  Summary npe_continuous{}, npe_discrete{}, rmse{}, fit{}, fpe{}, mae{};
  Summary seconds{};
  std::vector<ParameterRow> parameters{};
  std::vector<std::string> not_estimated{};  // parameters of the truth that never were
};

/// The leaderboard of a run, best identifier first.
struct Leaderboard {
  std::string suite{}, question{};
  int realizations = 0;  // in the store, of all variants
  double bound_npe_continuous = 0,
         bound_npe_discrete = 0;  // rms NPE at the Cramer-Rao bound, or NaN
  std::vector<LeaderboardRow> rows{};
  std::string variant{};            // of a group
  std::optional<double> value{};    // of the ladder's variable, of a group
  std::vector<Leaderboard> groups;  // of a suite with a ladder, in its order
};

/// Sums up a run directory. Throws BadInput.
Leaderboard ReadLeaderboard(const std::filesystem::path& directory);

/// The same as `warmjoint compare --format` prints it: text, markdown, json or csv. Throws BadInput.
std::string FormatLeaderboard(const std::filesystem::path& directory,
                              const std::string& format = "text");

}  // namespace warmjoint::api

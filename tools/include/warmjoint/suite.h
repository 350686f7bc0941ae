// Suites: many realizations, several identifiers, one leaderboard. What `warmjoint run` and `warmjoint compare` do.
//
//   RunArguments arguments;
//   arguments.suite = "table1.yaml";
//   arguments.output = "RUN";
//   arguments.realizations = 50;
//   Run(arguments);
//   std::puts(FormatLeaderboard("RUN", "text").c_str());
#pragma once

#include <warmjoint/claim.h>
#include <warmjoint/field.h>
#include <warmjoint/friction.h>
#include <warmjoint/recording.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace warmjoint {

/// Whether commands run within a sandbox, or with all that the user may do.
enum class Confinement { sandbox, none };

/// Most threads of a run.
inline constexpr int kMostJobs = 1024;

/// An identifier of the caller's own: the text of an estimate.json for a log, as a command writes it. Called from several
/// threads; what it throws is a realization without an answer.
using AnswerFunction = std::function<std::string(const Measurements&)>;

/// What is run and how; each member is called as its option of the command line.
struct RunArguments {
  std::string suite;
  std::string output;
  std::optional<std::uint64_t> jobs;
  std::optional<std::uint64_t> realizations;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> identifiers;
  std::string shard = "1/1";
  std::map<std::string, AnswerFunction> functions;  // by label, with those that `identifiers` names
  bool keep = false;
  bool allow_commands = false;
  Confinement confinement = Confinement::sandbox;  // of commands

  // of a run in shards
  bool slurm = false;
  std::optional<std::uint64_t> local_shards;  // processes on this machine
  std::optional<std::uint64_t> shards;
  std::vector<std::string> sbatch;  // key=value
  bool dry_run = false;

  bool in_shards() const { return slurm || local_shards; }

  /// What is no matter of files, functions and machines.
  template <class A>
  void Serialize(A* a) {
    a->Field("identifiers", &identifiers);
    a->Field("jobs", &jobs);
    a->Field("realizations", &realizations);
    a->Field("seed", &seed);
  }
};

/// What is said of a run at its end.
struct RunEnding {
  std::size_t results = 0;
  std::size_t refused = 0;        // by the identifier's own verdict: an answer as any other
  std::size_t unanswered = 0;     // crashed, took too long, or wrote something else
  std::size_t not_simulated = 0;  // there was nothing to identify
  /// Identifiers that answered in no realization, be it with a verdict: label, and the first reason.
  std::vector<std::pair<std::string, std::string>> silent;
  int realizations = 0;  // of all variants that are in the store
  std::string
      not_following;  // of joints that did not follow their motion: how many, and what cures it

  std::size_t failed() const { return refused + unanswered + not_simulated; }
};

/// Runs a suite into a directory, or goes on where an earlier run stopped, in this process. Results are those of `warmjoint
/// run`, bit for bit on one kind of machine. watch: is told how many realizations of how many are in the store; what it throws
/// ends the run, resumably. Throws BadInput and OutputFailed.
RunEnding Run(const RunArguments& arguments,
              const std::function<void(int finished, int total)>& watch = {});

/// Median and quartiles of a sample; NaN of an empty one.
struct Quartiles {
  double median;
  double q25;
  double q75;

  template <class A>
  void Serialize(A* a) {
    a->Field("median", &median);
    a->Field("q25", &q25);
    a->Field("q75", &q75);
  }
};

/// The same and the root mean square.
struct Summary : Quartiles {
  double rms;

  template <class A>
  void Serialize(A* a) {
    Quartiles::Serialize(a);
    a->Field("rms", &rms);
  }
};

/// How far a row is behind the best one, by pairs of the same realization.
struct Difference {
  double median = 0;  // of NPE - NPE of the best; infinite where mostly this one alone fails
  double lower = 0;   // 95 % interval of that median, bootstrap
  double upper = 0;
  bool tie() const { return lower <= 0 && upper >= 0; }

  template <class A>
  void Serialize(A* a) {
    std::array<double, 2> interval{lower, upper};
    bool is_tie = tie();
    a->Field("median", &median);
    a->Field("interval95", &interval);
    a->Field("tie", &is_tie);
  }
};

/// One parameter of the truth over all realizations.
struct ParameterRow {
  std::string name;
  std::optional<double> coverage95;  // share of intervals that hold the truth; empty without any
  double efficiency = 0;             // rms error / rms Cramer-Rao bound; 1 is best, NaN unknown
};

/// What a compensator reaches over all realizations: %, N.m or N.
struct MeasureRow {
  std::string name;
  Summary summary{};
};

/// Whether a row takes part, or is a measure for the others: a compensator that knows the truth.
enum class Standard { contestant, truth };

/// One identifier or compensator over all realizations. Summaries run over the realizations that it answered.
struct LeaderboardRow {
  std::string identifier;  // label
  int runs = 0;
  std::map<std::string, int> failures;  // status: count; every status but ok
  std::string failure_example;          // message of the first failure
  Summary npe_continuous{}, npe_discrete{}, rmse{}, fit{}, fpe{}, mae{};
  Summary seconds{};
  std::vector<ParameterRow> parameters;  // continuous, in the order of the truth
  std::vector<MeasureRow> measures;      // of a compensator, the one that ranks first
  Standard standard = Standard::contestant;
  std::vector<std::string> not_estimated;  // continuous parameters that never were; count as 0
  std::optional<Claim> claim;
  std::optional<Difference> behind;  // empty for the best itself, and over several variants
  std::optional<int> best_or_tied;   // of several variants, those in which nobody is better
  /// Median continuous NPE, of a compensator the median of its first measure, with runs without an answer as infinite.
  double rank_npe = 0;

  int failed() const;

  template <class A>
  void Serialize(A* a) {
    std::map<std::string, Summary> npe{{"continuous", npe_continuous}, {"discrete", npe_discrete}};
    std::vector<std::pair<std::string, double>> coverage95, efficiency;
    for (const ParameterRow& one : parameters) {
      if (one.coverage95) coverage95.emplace_back(one.name, *one.coverage95);
      if (std::isfinite(one.efficiency)) efficiency.emplace_back(one.name, one.efficiency);
    }
    std::map<std::string, double> time{{"median", seconds.median}};
    std::map<std::string, Quartiles> reached;
    for (const MeasureRow& one : measures) reached.emplace(one.name, one.summary);
    a->Field("identifier", &identifier);
    a->Field("runs", &runs);
    a->Field("failures", &failures);
    a->Field("npe", &npe);
    a->template Field<Quartiles>("rmse", &rmse);
    a->template Field<Quartiles>("fit", &fit);
    a->template Field<Quartiles>("fpe", &fpe);
    a->template Field<Quartiles>("mae", &mae);
    a->Field("coverage95", &coverage95);
    a->Field("efficiency", &efficiency);
    a->Field("measures", &reached, {.at_default = AtDefault::left_out});
    a->Field("seconds", &time);
    a->Field("not_estimated", &not_estimated);
    a->Field("behind_best", &behind);
    a->Field("best_or_tied", &best_or_tied);
    a->Field("claim", &claim);
  }
};

/// Realizations of a suite, or of one of its variants, summed up.
struct Standing {
  int realizations = 0;              // of the suite
  int finished = 0;                  // of them in the store
  double bound_npe_continuous = 0;   // rms NPE of an estimate at the Cramer-Rao bound, or NaN
  double bound_npe_discrete = 0;     // the same for the discrete pair
  std::vector<LeaderboardRow> rows;  // best first

  template <class A>
  void Serialize(A* a) {
    std::map<std::string, std::map<std::string, double>> bound{
        {"continuous", {{"rms", bound_npe_continuous}}},
        {"discrete", {{"rms", bound_npe_discrete}}}};
    a->Field("realizations", &finished);
    a->Field("bound_npe", &bound);
    a->Field("rows", &rows);
  }
};

/// One variant of a suite with a ladder.
struct VariantStanding : Standing {
  std::string variant;
  std::optional<double> value;  // of the ladder's variable

  template <class A>
  void Serialize(A* a) {
    a->Field("variant", &variant);
    a->Field("value", &value, {.at_default = AtDefault::null});
    Standing::Serialize(a);
  }
};

/// The leaderboard of a run, best identifier first: of a ladder the one that is best or tied in the most variants.
struct Leaderboard : Standing {
  std::string suite;
  std::string question;
  JointKind joint = JointKind::rotary;
  std::string variable;                 // what the ladder climbs, with its unit; empty without
  std::vector<VariantStanding> groups;  // of a ladder, in its order

  template <class A>
  void Serialize(A* a) {
    a->Field("suite", &suite);
    a->Field("question", &question);
    Standing::Serialize(a);
    const AtDefault without = groups.empty() ? AtDefault::left_out : AtDefault::written;
    a->Field("variable", &variable, {.at_default = without});
    a->Field("groups", &groups, {.at_default = without});
  }
};

/// Sums up a run directory. Throws BadInput.
Leaderboard ReadLeaderboard(const std::filesystem::path& directory);

/// The same as `warmjoint compare --format` prints it: text, markdown, json or csv. Throws BadInput.
std::string FormatLeaderboard(const std::filesystem::path& directory,
                              const std::string& format = "text");

}  // namespace warmjoint

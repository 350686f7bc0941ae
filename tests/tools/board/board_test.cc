// Leaderboards and their statistics.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "models/foundation/random_stream.h"
#include "models/foundation/robust_noise.h"
#include "tests/tools/scratch_directory.h"
#include "tests/tools/store/little_suite.h"
#include "tools/board/board_tables.h"
#include "tools/board/format_board.h"
#include "tools/board/leaderboard.h"
#include "tools/board/statistics.h"

namespace warmjoint {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A result of one parameter "coulomb" with truth 10, bound 0.5 and interval estimate +- 1.
Result Answered(int realization, int identifier, double estimate) {
  Result result;
  result.realization = realization;
  result.identifier = identifier;
  result.status = "ok";
  result.metrics = Metrics{100, 1, 1, 0.5, 0.4, 95, 0.25};
  const double npe = std::abs(estimate - 10) / 10;
  const ParameterScore score{"coulomb", 10, estimate, true, std::abs(estimate - 10) <= 1, 0.5};
  result.score = Score{{score}, {score}, npe, npe, 0.05, 0.05};
  result.seconds = 0.001;
  return result;
}

Result Failure(int realization, int identifier, const std::string& status) {
  Result result;
  result.realization = realization;
  result.identifier = identifier;
  result.status = status;
  result.message = "no idea";
  result.seconds = 0.001;
  return result;
}

/// The board of a run that holds these results, ordered by unit. more: further entries of the suite.
Leaderboard BoardOf(const std::vector<Result>& results, const std::string& more = "") {
  const ScratchDirectory scratch;
  RunStore store = RunStore::CreateOrResume(scratch.path() / "run", LittleRun(more));
  std::vector<Realization> units;
  for (const Result& result : results) {
    const RunUnit unit{result.variant, result.realization};
    if (units.empty() || units.back().unit != unit) units.push_back({unit, 0.1, {}});
    units.back().results.push_back(result);
  }
  store.Write(units);
  return ReadBoard(store);
}

std::vector<Result> AFailsTwiceAndBIsOftenWorse() {
  return {Answered(0, 0, 10.1),
          Answered(0, 1, 12),
          Failure(1, 0, "not_converged"),
          Answered(1, 1, 11),
          Answered(2, 0, 9.9),
          Answered(2, 1, 9.5),
          Failure(3, 0, "not_converged"),
          Answered(3, 1, 10.5)};
}

TEST(Leaderboard, SumsUpEachIdentifierOfWhichThoseThatFailCannotWin) {
  const Leaderboard board = BoardOf(AFailsTwiceAndBIsOftenWorse());
  ASSERT_EQ(board.rows.size(), 2u);
  const LeaderboardRow& b = board.rows[0];
  EXPECT_EQ(b.identifier, "b");
  EXPECT_EQ(b.runs, 4);
  EXPECT_TRUE(b.failures.empty());

  // errors 2, 1, -0.5, 0.5 of 10; the bound of each is 0.5
  EXPECT_DOUBLE_EQ(b.npe_continuous.median, 0.075);
  EXPECT_DOUBLE_EQ(b.npe_continuous.rms, std::sqrt(5.5 / 4) / 10);
  ASSERT_EQ(b.parameters.size(), 1u);
  EXPECT_EQ(b.parameters[0].coverage95, std::optional(0.75));
  EXPECT_DOUBLE_EQ(b.parameters[0].efficiency, std::sqrt(5.5 / 4) / 0.5);
  EXPECT_DOUBLE_EQ(board.bound_npe_continuous, 0.05);

  const LeaderboardRow& a = board.rows[1];
  EXPECT_EQ(a.identifier, "a") << "better where it answers, but it fails half of the runs";
  EXPECT_EQ(a.failures.at("not_converged"), 2);
  EXPECT_NEAR(a.npe_continuous.median, 0.01, 1e-15);
  EXPECT_EQ(a.failure_example, "no idea");
}

TEST(Leaderboard, VariantsWhoseTruthsHaveOtherParametersAreToldApartByName) {
  const auto answer = [](int variant, double estimate) {
    Result result = Answered(0, 0, estimate);
    result.variant = variant;
    const ParameterScore more{"stribeck_velocity", 1, 3, true, false, 4};
    if (variant == 1) result.score->continuous.insert(result.score->continuous.begin(), more);
    return result;
  };
  const Leaderboard board = BoardOf({answer(0, 11), answer(1, 12)},
                                    "ladder: {variants: {plain: {}, richer: {noise.torque: 1}}}\n");
  const auto& rows = board.rows[0].parameters;
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].name, "coulomb");
  EXPECT_DOUBLE_EQ(rows[0].efficiency, std::sqrt(2.5) / 0.5);
  EXPECT_EQ(rows[0].coverage95, std::optional(0.5));
  EXPECT_EQ(rows[1].name, "stribeck_velocity");
  EXPECT_DOUBLE_EQ(rows[1].efficiency, 0.5);
}

TEST(Leaderboard, OfALadderRanksWithinEachVariant) {
  // errors of variant 1 are a hundred times those of variant 0, where b is better; in variant 1 it is a, by less than that
  std::vector<Result> results;
  for (int variant : {0, 1, 2}) {
    for (int i = 0; i < 8; ++i) {
      const double unit = variant == 1 ? 1 : 0.01, spread = 1 + 0.01 * i;
      const double a = variant == 1 ? 1 : 2, b = variant == 1 ? 2 : 1;
      for (const auto& [identifier, error] : {std::pair(0, a), std::pair(1, b)}) {
        results.push_back(Answered(i, identifier, 10 + error * spread * unit));
        results.back().variant = variant;
      }
    }
  }
  const Leaderboard board =
      BoardOf(results, "ladder: {variable: noise.torque, values: [0.1, 1, 0.2], unit: N.m}\n");
  ASSERT_EQ(board.rows.size(), 2u);
  EXPECT_EQ(board.rows[0].identifier, "b")
      << "best in two of three, though its pooled rms is larger";
  EXPECT_EQ(board.rows[0].best_or_tied, 2);
  EXPECT_EQ(board.rows[1].best_or_tied, 1);
  EXPECT_EQ(board.groups[1].rows[0].identifier, "a");
  EXPECT_EQ(
      Verdict(board),
      "b is best or tied in 2 of 3 variants, its rms 0.02 to 4.14 times the Cramer-Rao bound; "
      "a in 1.");
  EXPECT_THAT(RankingTable(board).rows[0], ElementsAre("1", "b", "2 of 3", "0", "0.0207 .. 4.14"));
  EXPECT_THAT(GroupTable(board).rows[1], ElementsAre("1", "5.00 %", "20.7 %", "10.4 % best"));

  // what is measured under different noise is put together in no format
  const auto json = nlohmann::json::parse(BoardToJson(board));
  EXPECT_EQ(json.at("rows").at(0).at("best_or_tied"), 2);
  EXPECT_FALSE(json.at("rows").at(1).contains("behind_best"));
  EXPECT_TRUE(json.at("groups").at(0).at("rows").at(1).contains("behind_best"));
  const std::string csv = BoardToCsv(board);
  EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 3 * 2);
  EXPECT_THAT(BoardsToText({{"run", board}}), HasSubstr("run: 0.2"));
}

TEST(Leaderboard, NamesParametersThatCountAsZero) {
  Result blind = Answered(0, 0, 0);
  blind.score->continuous[0].estimated = false;
  const Leaderboard board = BoardOf({blind});
  const auto row = std::find_if(board.rows.begin(), board.rows.end(),
                                [](const LeaderboardRow& one) { return one.identifier == "a"; });
  EXPECT_THAT(row->not_estimated, ElementsAre("coulomb"));
  EXPECT_THAT(BoardToText(board), HasSubstr("a does not estimate coulomb, which count as 0"));
}

TEST(Leaderboard, JsonHasTheKeysOfTheContract) {
  const auto json = nlohmann::json::parse(BoardToJson(BoardOf(AFailsTwiceAndBIsOftenWorse())));
  EXPECT_EQ(json.at("suite"), "little");
  EXPECT_EQ(json.at("realizations"), 4);
  const auto& a = json.at("rows").at(1);
  EXPECT_EQ(a.at("identifier"), "a");
  EXPECT_EQ(a.at("runs"), 4);
  EXPECT_EQ(a.at("failures").at("not_converged"), 2);
  for (const char* family : {"continuous", "discrete"}) {
    for (const char* key : {"median", "q25", "q75", "rms"}) {
      EXPECT_TRUE(a.at("npe").at(family).at(key).is_number()) << family << "." << key;
    }
  }
  for (const char* metric : {"rmse", "fit", "fpe", "mae"}) {
    for (const char* key : {"median", "q25", "q75"}) {
      EXPECT_TRUE(a.at(metric).at(key).is_number()) << metric << "." << key;
    }
  }
  EXPECT_EQ(a.at("coverage95").at("coulomb"), 1.0);
  EXPECT_TRUE(a.at("efficiency").at("coulomb").is_number());
  EXPECT_EQ(a.at("seconds").at("median"), 0.001);
}

TEST(Leaderboard, JsonSaysNullForWhatDoesNotExist) {
  const auto json = nlohmann::json::parse(BoardToJson(BoardOf({Failure(0, 0, "crashed")})));
  EXPECT_TRUE(json.at("rows").at(0).at("npe").at("continuous").at("median").is_null());
}

TEST(Leaderboard, TextOfSuitesReachesNoTerminalAndNoPageAsItIs) {
  Leaderboard board = BoardOf(AFailsTwiceAndBIsOftenWorse());
  board.question = "Which \x1B[31m\u202E <b>?";
  board.rows[0].identifier = "b\x1B]0;x\x07";
  EXPECT_THAT(BoardToText(board), HasSubstr(R"(little: Which \x1B[31m\u202E <b>?)"));
  const std::string markdown = BoardToMarkdown(board);
  EXPECT_THAT(markdown, HasSubstr(R"(Which \x1B[31m\u202E &lt;b>?)"));
  for (const std::string& text : {BoardToText(board), markdown, BoardsToText({{"run\x1B", board}}),
                                  BoardsToMarkdown({{"run\x1B", board}})}) {
    EXPECT_EQ(text.find_first_of("\x1B\x07"), std::string::npos) << text;
  }
}

TEST(Leaderboard, FlagsErrorsThatNoDataAllow) {
  // 8 realizations; the bound is 0.5, so that errors of 0.001 are 1/500 of it and 0.4 are ordinary
  std::vector<Result> results;
  for (int i = 0; i < 8; ++i) {
    results.push_back(Answered(i, 0, 10.001));
    results.push_back(Answered(i, 1, i % 2 ? 10.4 : 9.6));
  }
  const std::vector<std::string> notes = Notes(BoardOf(results));
  EXPECT_THAT(notes, testing::Contains(testing::AllOf(testing::StartsWith("a: "),
                                                      HasSubstr("does it know the truth?"))));
  EXPECT_THAT(notes, testing::Not(testing::Contains(testing::AllOf(
                         testing::StartsWith("b: "), HasSubstr("does it know the truth?")))));
}

constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(Statistics, SummariseKnownSamples) {
  const Summary summary = Summarise(std::vector<double>({4, 1, 3, 2}));
  EXPECT_EQ(summary.median, 2.5);
  EXPECT_EQ(summary.q25, 1.75);
  EXPECT_EQ(summary.q75, 3.25);
  EXPECT_DOUBLE_EQ(summary.rms, std::sqrt(30.0 / 4));
}

TEST(Statistics, LeaveOutWhatIsNoNumber) {
  const Summary summary = Summarise(std::vector<double>({NAN, 2, NAN}));
  EXPECT_EQ(summary.median, 2);
  EXPECT_EQ(summary.rms, 2);
  EXPECT_TRUE(std::isnan(Summarise(std::vector<double>({NAN})).median));
  EXPECT_TRUE(std::isnan(Summarise(std::vector<double>({})).rms));
}

TEST(Statistics, QuantilesStandInfinities) {
  EXPECT_EQ(Quantile({1, kInfinite, kInfinite}, 0.5), kInfinite);
  EXPECT_EQ(Quantile({1, 2, kInfinite}, 0.5), 2);
}

/// The smallest value that the lower median of a resample does not exceed with probability `level`: all
/// n^n resamples of the values, counted.
double ByCounting(std::vector<double> values, double level) {
  const std::size_t n = values.size();
  std::vector<double> medians;
  std::vector<std::size_t> drawn(n, 0);
  for (bool more = true; more;) {
    std::vector<double> sample;
    for (const std::size_t i : drawn) sample.push_back(values[i]);
    std::sort(sample.begin(), sample.end());
    medians.push_back(sample[(n - 1) / 2]);
    // the next one, as an odometer counts
    std::size_t digit = 0;
    while (digit < n && ++drawn[digit] == n) drawn[digit++] = 0;
    more = digit < n;
  }
  std::sort(medians.begin(), medians.end());
  const double count = std::ceil(level * static_cast<double>(medians.size()));
  return medians[static_cast<std::size_t>(count) - 1];
}

TEST(MedianDifference, HasTheIntervalOfAllResamples) {
  const std::vector<double> values{0.3, -1, 2, 5, 0.7, -4};
  for (std::size_t n = 1; n <= values.size(); ++n) {
    const std::vector<double> some(values.begin(), values.begin() + static_cast<long>(n));
    const Difference difference = MedianDifference(some);
    EXPECT_EQ(difference.lower, ByCounting(some, 0.025)) << n;
    EXPECT_EQ(difference.upper, ByCounting(some, 0.975)) << n;
  }
}

TEST(MedianDifference, OfAMillionHasTheWidthOfTheAsymptoticInterval) {
  RandomStream random({2, 0}, Stream::test);
  const int n = 1000000;
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(random.Normal());
  const Difference difference = MedianDifference(values);
  // the median of n normal draws has the standard deviation sqrt(pi / (2 n)); the ends scatter by
  // some n^(-3/4) about their places, 3 % of the width
  const double width = 2 * 1.96 * std::sqrt(std::acos(-1) / 2 / n);
  EXPECT_NEAR(difference.upper - difference.lower, width, 0.1 * width);
}

TEST(MedianDifference, TakesInfinitiesAndNothing) {
  EXPECT_EQ(MedianDifference({kInfinite, kInfinite, 0}).median, kInfinite);
  EXPECT_TRUE(std::isnan(MedianDifference({}).median));
  EXPECT_TRUE(MedianDifference({0, 0}).tie());
}

}  // namespace
}  // namespace warmjoint

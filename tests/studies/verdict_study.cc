// What verdicts say over many realizations of a suite, on the path that users take.
//
//   verdict_study SUITE.yaml [REALIZATIONS [VARIANT...]]
//
// For each variant and identifier: how often each status, how often 95 % intervals hold the truth,
// how often each test for lack of fit is made and rejects, and how large what it finds is, as a
// share of the friction's rms. Rates stand with their binomial standard error. On clean scenarios
// the rates of rejection are false alarms, on spoilt ones power.
//
// A log counts as confidently wrong where its status is ok and the truth of a parameter lies more
// than three deviations (interval / 3.92) beyond an end of its 95 % interval. Beside coverage stand,
// over the Cramer-Rao bound of the noise: mean error, its rms, the reported standard deviation (rms),
// and the median of the interval's width over 3.92. Ranks: of
// the truth among what the estimate holds likely, which are even where intervals of all levels cover as they say; p of
// Kolmogorov and Smirnov's test of that. An assumption reaches the truth of a log where
// every interval, made as much longer at both ends as the assumption moves the parameter, holds it; behind that stands
// how often none of them leaves the truth more than three deviations outside, as an answer that is not confidently wrong,
// and how often it reaches the truth of all parameters that it moves: the others' intervals miss as often as 5 % each.
// Friction at speeds, beside the truth's law with the heat of its warmest moment, of truths without maps: coverage, how often it is
// confidently wrong, median |z| (.67 is honest) and median half width as a share of the friction.
// Ideal chi2: squares that the fit leaves of the torque without noise, over the noise's variance; median and quartiles
// over the logs. Behind it the share that is confidently wrong of the logs where it is above 30.
#include <fmt/format.h>
#include <warmjoint/prepared_log.h>
#include <warmjoint/score.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "identification/answer/identify.h"
#include "identification/fit/fit_data.h"
#include "identification/fit/seen_samples.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/inference/inference.h"
#include "identification/lack_of_fit/fitted_model.h"
#include "models/foundation/robust_noise.h"
#include "models/friction/sign.h"
#include "scenarios/suite.h"
#include "sim/plant/plant.h"
#include "tests/studies/for_each_variant.h"

namespace warmjoint {
namespace {

/// p of Kolmogorov and Smirnov's test: the probability that n even numbers lie at least as far from evenness, by the
/// limiting distribution with Stephens' correction for n (Use of the Kolmogorov-Smirnov, Cramer-von Mises and related
/// statistics without extensive tables, 1970), right to 1 % from n = 20 on. 1 without numbers.
double ProbabilityOfEvenness(std::vector<double> numbers) {
  if (numbers.empty()) return 1;
  std::ranges::sort(numbers);
  const auto n = static_cast<double>(numbers.size());
  double distance = 0, below = 0;
  for (const double number : numbers) {
    distance = std::max({distance, number - below / n, (below + 1) / n - number});
    ++below;
  }

  const double root = std::sqrt(n), scaled = (root + 0.12 + 0.11 / root) * distance;
  constexpr double all = 0.3;  // below that p is 1 to 1e-5, and the series converges slowly
  if (scaled < all) return 1;
  double p = 0, sign = 1;
  for (int k = 1; k <= 100; ++k, sign = -sign) {
    p += 2 * sign * std::exp(-2 * k * k * scaled * scaled);
  }
  return std::clamp(p, 0.0, 1.0);
}

/// Squares that the model of a fit leaves at least: plain least squares from where the fit ended, since
/// a whitened one leaves more. -1 where there is no fit.
double LeastSquaresOf(Fit fit, const LogSamples& m, const Selection& selection) {
  constexpr int kSteps = 8;
  double least = -1;
  for (int step = 0; step < kSteps; ++step) {
    const std::optional<FittedModel> model = EvaluateModel(fit, Infer(fit), m, selection);
    if (!model || !model->residual.allFinite() || !model->derivatives.allFinite()) break;
    const Eigen::VectorXd residual = Kept(model->residual, model->selection);
    const Eigen::MatrixXd rows = Kept(model->derivatives, model->selection);
    const Eigen::VectorXd move = rows.colPivHouseholderQr().solve(residual);
    const double squares = (residual - rows * move).squaredNorm();
    if (least >= 0 && squares > least) break;
    least = squares;

    // from there on
    for (size_t i = 0; i < model->rows.size(); ++i) {
      Unknown& row = fit.parameters[model->rows[i]];
      row.value += move[static_cast<Eigen::Index>(i)];
      if (row.role == Role::law) fit.model.friction.parameters[row.name] = row.value;
      if (row.name == "thermal_gain") fit.model.friction.thermal->gain = row.value;
      if (row.name == "thermal_time_constant")
        fit.model.friction.thermal->time_constant = row.value;
    }
  }
  return least;
}

/// What an identifier's model leaves of the torque of logs without torque noise.
class IdealChi2 {
 public:
  explicit IdealChi2(const Scenario& scenario) : variance_(std::pow(scenario.noise.torque, 2)) {
    Scenario quiet = scenario;
    quiet.noise.torque = 0;
    if (variance_ > 0) plant_ = MakePlant(quiet);
  }

  /// Squares over the variance of the scenario's noise, of one realization; nothing where there is no fit or no
  /// noise. Noise of other sensors stays. Below about 30 no test can see that the model is wrong.
  std::optional<double> Of(const SuiteIdentifier& one, std::uint64_t realization) const {
    if (!plant_) return {};
    const Identifier& identifier = FindIdentifier(one.name);
    const PreparedLog log = Prepare(plant_->Run(realization).measurements);
    const IdentifierInput given{log, identifier.options.Read(one.options, {one.label}), {}};
    const IdentifierInput input = SelectSamples(identifier, given);
    const double squares =
        LeastSquaresOf(identifier.fit(input), input.measurements, input.selection);
    if (squares < 0) return {};
    return squares / variance_;
  }

 private:
  double variance_;
  std::unique_ptr<Plant> plant_;
};

constexpr double kVisible = 30;  // ideal chi2 above which a test can see that the model is wrong

/// How often something happened.
struct Rate {
  int times = 0, of = 0;

  void Count(bool happened) {
    times += happened;
    ++of;
  }
  /// "93.5 +- 1.2 %"
  std::string Text() const {
    const double share = static_cast<double>(times) / std::max(of, 1);
    return fmt::format("{:.1f} +- {:.1f} %", 100 * share,
                       100 * std::sqrt(share * (1 - share) / std::max(of, 1)));
  }
};

/// What became of one parameter.
struct ParameterRates {
  Rate covered;
  double error = 0, squares = 0, variance = 0;  // sums, over the bound
  std::vector<double> widths, ranks;

  void Count(const ParameterScore& one, const EstimatedParameter& estimated) {
    covered.Count(*one.covered);
    const double off = (one.estimate - one.truth) / one.bound;
    error += off;
    squares += off * off;
    if (estimated.std) variance += std::pow(*estimated.std / one.bound, 2);
    const auto [lower, upper] = *estimated.interval95;
    const double deviation = (upper - lower) / kIntervalWidth;
    widths.push_back(deviation / one.bound);
    ranks.push_back(0.5 * std::erfc((one.estimate - one.truth) / deviation / std::numbers::sqrt2));
  }
  std::string Text() {
    const auto n = static_cast<double>(std::max(covered.of, 1));
    std::ranges::nth_element(widths, widths.begin() + static_cast<Eigen::Index>(widths.size() / 2));
    return fmt::format(
        "{:16} mean error {:5.2f} +- {:.2f}, rms {:.2f}, std {:.2f}, width {:.2f} bounds, "
        "ranks p {:.2g}",
        covered.Text(), error / n, std::sqrt(squares / n / n), std::sqrt(squares / n),
        std::sqrt(variance / n), widths[widths.size() / 2], ProbabilityOfEvenness(ranks));
  }
};

constexpr double kUnmoved = 1e-6;  // of an interval's width

/// How an assumption's moves compare with the truth of one log.
struct Reached {
  bool all = true;       // every interval holds it once it reaches as far as its parameter is moved
  bool nearly = true;    // to three deviations
  bool of_moved = true;  // every one of a parameter that is moved at all

  Reached(const ParameterMoves& moves, const Estimate& estimate, const Score& score) {
    for (const ParameterScore& one : score.continuous) {
      if (!one.covered) continue;
      const auto [lower, upper] = *estimate.Find(one.name)->interval95;
      const double width = upper - lower;
      const auto found = std::ranges::find(moves, one.name, &ParameterMoves::value_type::first);
      const double move = found == moves.end() ? 0 : std::abs(found->second);
      const double short_by = std::max(lower - one.truth, one.truth - upper) - move;
      all = all && short_by <= 0;
      nearly = nearly && short_by <= kFarDeviations * width / kIntervalWidth;
      of_moved = of_moved && (short_by <= 0 || move <= kUnmoved * width);
    }
  }
};

/// Outcomes of one test.
struct TestRates {
  Rate made, rejected;
  double effects = 0;  // sum over rejections, shares of the friction's rms
};

/// What became of friction at speeds.
struct SpeedRates {
  Rate covered, far;
  std::vector<double> z, half_widths;  // half widths over the friction

  void Count(const Estimate& estimate, const Truth& truth) {
    if (!truth.friction.maps.empty()) return;
    const Law& law = *FindLaw(truth.friction.law);
    const std::vector<double> values = LawValues(truth.friction);
    Eigen::Index warmest = 0;
    if (truth.energy.size() > 0) truth.energy.cwiseAbs().maxCoeff(&warmest);
    for (const FrictionAtSpeed& one : estimate.friction_at_speeds) {
      double value = Sign(one.speed) * law.force(one.speed, values.data());
      if (one.energy.value_or(0) != 0) value += truth.energy[warmest];
      const auto [lower, upper] = one.interval95;
      const double deviation = (upper - lower) / kIntervalWidth;
      covered.Count(lower <= value && value <= upper);
      far.Count(value < lower - kFarDeviations * deviation ||
                value > upper + kFarDeviations * deviation);
      z.push_back(std::abs(one.value - value) / deviation);
      half_widths.push_back(0.5 * (upper - lower) / std::abs(value));
    }
  }

  void Print() const {
    if (z.empty()) return;
    const auto median = [](const std::vector<double>& of) {
      Eigen::VectorXd all =
          Eigen::Map<const Eigen::VectorXd>(of.data(), static_cast<Eigen::Index>(of.size()));
      return MedianInPlace(all);
    };
    fmt::print(
        "    friction at speeds       {:16} confidently wrong {}, median |z| {:.2f}, median half "
        "width {:.2g} %\n",
        covered.Text(), far.Text(), median(z), 100 * median(half_widths));
  }
};

/// Outcomes of one identifier in one variant.
struct Outcomes {
  std::map<std::string, int> statuses;
  std::map<std::string, ParameterRates> parameters;
  std::map<std::string, TestRates> tests;
  std::map<std::string, Rate> reaches;  // of assumptions
  std::map<std::string, Rate> nears;    // to three deviations
  std::map<std::string, Rate> moved;    // that of the parameters which are moved
  Rate alarms;                          // any test rejects
  Rate refused;                         // not ok
  Rate warned;                          // ok, with a test that rejects
  Rate wrong;                           // confidently
  SpeedRates at_speeds;
  std::vector<double> chi2;  // ideal
  Rate visibly_wrong;        // confidently, of the logs whose ideal chi2 is above kVisible

  void Count(const Estimate& estimate, const Simulation& recording, const LogView& view,
             std::optional<double> ideal) {
    ++statuses[std::string(StatusName(estimate.status))];
    const double friction = std::sqrt(recording.truth.force.squaredNorm() /
                                      static_cast<double>(recording.truth.force.size()));
    bool any = false;
    for (const Diagnostic& one : estimate.diagnostics) {
      TestRates& test = tests[one.test];
      test.made.Count(one.made);
      if (!one.made) continue;
      test.rejected.Count(one.rejected);
      if (one.rejected) test.effects += one.effect / friction;
      any = any || one.rejected;
    }
    const bool ok = estimate.status == Status::ok;
    alarms.Count(any);
    refused.Count(!ok);
    warned.Count(ok && any);
    bool far = false;
    if (ok) at_speeds.Count(estimate, recording.truth);
    if (ok) {
      const Score score =
          ScoreEstimate(estimate, view.measurements, view.selection, recording.truth);
      for (const ParameterScore& one : score.continuous) {
        if (!one.covered) continue;
        const EstimatedParameter& estimated = *estimate.Find(one.name);
        parameters[one.name].Count(one, estimated);
        far = far || IsFarOutside(one, *estimated.interval95);
      }
      for (const Assumption& one : estimate.assumptions) {
        const Reached reached(one.moves, estimate, score);
        reaches[one.name].Count(reached.all);
        nears[one.name].Count(reached.nearly);
        moved[one.name].Count(reached.of_moved);
      }
    }
    wrong.Count(far);
    if (ideal) chi2.push_back(*ideal);
    if (ideal && *ideal > kVisible) visibly_wrong.Count(far);
  }

  /// "33.8 (15.5 .. 45.7)": median and quartiles; "-" where there are none.
  std::string Chi2Text() const {
    if (chi2.empty()) return "-";
    Eigen::VectorXd all =
        Eigen::Map<const Eigen::VectorXd>(chi2.data(), static_cast<Eigen::Index>(chi2.size()));
    const auto at = [&](double share) { return QuantileInPlace(all, share); };
    return fmt::format("{:.3g} ({:.3g} .. {:.3g})", at(0.5), at(0.25), at(0.75));
  }

  void Print() {
    for (const auto& [status, count] : statuses) fmt::print("    {}: {}\n", status, count);
    fmt::print("    any test rejects {}, refused {}, ok with a finding {}\n", alarms.Text(),
               refused.Text(), warned.Text());
    fmt::print("    confidently wrong {}", wrong.Text());
    if (visibly_wrong.of > 0)
      fmt::print(", of the {} logs with ideal chi2 > {:.0f} {}", visibly_wrong.of, kVisible,
                 visibly_wrong.Text());
    fmt::print("\n");
    at_speeds.Print();
    for (const auto& [name, rate] : reaches) {
      fmt::print("    {:24} reaches the truth {}, to three deviations {}, of what it moves {}\n",
                 name, rate.Text(), nears[name].Text(), moved[name].Text());
    }
    for (auto& [name, rates] : parameters) fmt::print("    {:24} {}\n", name, rates.Text());
    for (const auto& [name, test] : tests) {
      if (test.made.times == 0) continue;
      fmt::print("    {:20} made {:4}  rejects {:16}", name, test.made.times, test.rejected.Text());
      if (test.rejected.times > 0) {
        fmt::print("  mean size {:.2g} % of the friction",
                   100 * test.effects / test.rejected.times);
      }
      fmt::print("\n");
    }
  }
};

void Study(const Suite& suite, int variant, int realizations) {
  const Scenario scenario = VariantScenario(suite, variant);
  fmt::print("{}\n",
             suite.ladder ? suite.ladder->variants[static_cast<size_t>(variant)].name : suite.name);
  const std::unique_ptr<Plant> plant = MakePlant(scenario);
  const IdealChi2 ideal(scenario);
  std::vector<Outcomes> outcomes(suite.identifiers.size());
  for (int r = 0; r < realizations; ++r) {
    const Simulation recording = plant->Run(static_cast<std::uint64_t>(r));
    const PreparedLog log = Prepare(recording.measurements);
    for (size_t i = 0; i < outcomes.size(); ++i) {
      const SuiteIdentifier& one = suite.identifiers[i];
      const Identifier& identifier = FindIdentifier(one.name);
      const Estimate estimate = IdentifyAndCheck(
          identifier, {log, identifier.options.Read(one.options, {one.label}), {}});
      outcomes[i].Count(estimate, recording, ScoredView(estimate, log),
                        ideal.Of(one, static_cast<std::uint64_t>(r)));
    }
  }
  for (size_t i = 0; i < outcomes.size(); ++i) {
    fmt::print("  {}, ideal chi2 {}\n", suite.identifiers[i].label, outcomes[i].Chi2Text());
    outcomes[i].Print();
  }
  std::fflush(stdout);
}

}  // namespace
}  // namespace warmjoint

int main(int count, char** arguments) {
  return warmjoint::StudyVariants("verdict_study", count, arguments, warmjoint::Study);
}

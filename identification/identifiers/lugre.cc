#include "identification/identifiers/lugre.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "identification/describe_friction.h"
#include "identification/fit_data.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/linear_laws.h"
#include "identification/nonlinear/lugre_answer.h"
#include "identification/nonlinear/lugre_data.h"
#include "identification/nonlinear/stribeck_fit.h"
#include "identification/nonlinear/stribeck_verdict.h"
#include "identification/uncertainty/student.h"
#include "identification/warming/unsettled.h"
#include "identification/warming/warming_verdict.h"
#include "models/friction/viscous_coulomb.h"

namespace warmjoint::inline identification {
namespace {

constexpr const char* kName = "lugre";
constexpr size_t kRefined = 3;         // starts
constexpr int kPasses = 3;             // of weighing the samples
constexpr double kNotable = 0.02;      // of the torque's rms
constexpr double kMissed = 2;          // rms around turns over that at constant speeds
constexpr double kVagueBristle = 0.5;  // standard deviation of a logarithm: a factor of e

constexpr ParameterInfo kInertiaInfo{"inertia", "M", {"N.m.s^2/rad", "N.s^2/m"}, 0,
                                     kInfinity, 0,   "torque over acceleration"};

/// {kv, kc, ks, ln vs} of the Stribeck curve, were presliding over after `distance`, rad or m;
/// nothing where the samples do not show one. A start, so that ks is kept within 1 and 3 kc.
std::optional<Eigen::Vector4d> SteadyStart(const IdentifierInput& input, double distance) {
  const Measurements& m = input.measurements;
  const Selection steady = SteadySamples(input, distance);
  if (steady.count() < 8) return std::nullopt;
  const Intervals intervals{{1}, std::vector<int>(static_cast<size_t>(m.size()), 0), 1};
  const StribeckProblem problem{m, steady, intervals, 2, Warming::none, 1};
  const std::vector<StribeckPoint> scan = ScanStribeckVelocity(problem);
  if (scan.empty()) return std::nullopt;
  Eigen::Vector4d start = scan[0].x;
  if (!(start[kLugreCoulomb] > 0)) return std::nullopt;
  start[kLugreStatic] =
      std::clamp(start[kLugreStatic], start[kLugreCoulomb], 3 * start[kLugreCoulomb]);
  return start;
}

/// Refines the first points and keeps the best of them and `best`.
void RefineBest(const LugreProblem& problem, const std::vector<LugrePoint>& points,
                std::optional<LugreFit>& best) {
  for (size_t i = 0; i < std::min(kRefined, points.size()); ++i) {
    LugreFit fit = RefineLugre(problem, points[i]);
    const bool better =
        !best ||
        (fit.converged && (!best->converged || fit.solution.squares < best->solution.squares));
    if (better) best = std::move(fit);
  }
}

/// The best of the refined starts. The first may have missed the fall of the Stribeck curve, which
/// few samples show: it is looked for again once the bristle is known.
LugreFit FitFrom(const LugreProblem& problem, const std::vector<LugrePoint>& scan, double fastest) {
  std::optional<LugreFit> best;
  RefineBest(problem, scan, best);
  RefineBest(problem, ScanFall(problem, best->solution, fastest), best);
  return *best;
}

/// Why bristle_stiffness cannot be told, or bristle_damping; nothing where they can.
std::optional<std::string> VagueBristle(const Measurements& m, const LugreAnswer& answer) {
  const auto p = LugreValues(answer.fit.solution.x.data());
  const double stiffness = answer.Deviation(kLugreLogStiffness);
  if (!(stiffness < kVagueBristle)) {
    return fmt::format(
        "bristle_stiffness and bristle_damping cannot be told: the samples around turns {}; turn "
        "slowly and over small ways, such that several "
        "samples fall between standstill and sliding, or use the law stribeck",
        std::isfinite(stiffness) ? fmt::format("know the stiffness to a factor of {:.3g} only",
                                               std::exp(1.96 * std::min(stiffness, 100.0)))
                                 : "say nothing of the stiffness");
  }
  if (answer.rows[kLugreDamping] < 0) return std::nullopt;
  const double damping = answer.Deviation(kLugreDamping);
  if (damping < kVagueBristle * std::abs(p[5])) return std::nullopt;
  return fmt::format(
      "bristle_damping cannot be told: it is {:.3g} with a standard deviation of {:.3g} {}; turn "
      "faster within the {:.2g} {} that the bristle bends, sampled in steps well below "
      "bristle_damping / bristle_stiffness, or give --set damping=none where it can be neglected",
      p[5], damping, kViscousUnit.For(m.joint), p[2] / p[4], kPositionUnit.For(m.joint));
}

/// Why static and stribeck_velocity cannot be told; nothing where they can.
std::optional<std::string> UnknownStribeck(const IdentifierInput& input,
                                           const LugreAnswer& answer) {
  const double fall = answer.fit.solution.x[kLugreStatic] - answer.fit.solution.x[kLugreCoulomb];
  const double variance = answer.Variance(kLugreStatic, kLugreStatic) +
                          answer.Variance(kLugreCoulomb, kLugreCoulomb) -
                          2 * answer.Variance(kLugreStatic, kLugreCoulomb);
  const double explained = fall * fall / variance;
  if (!(explained > kVisibleWarming)) {
    return fmt::format(
        "no Stribeck effect can be seen: static less coulomb is {:.3g} standard deviations, below "
        "{:.3g}; {}",
        std::sqrt(std::max(explained, 0.0)), std::sqrt(kVisibleWarming),
        SlowSpeeds(input.measurements, SteadySamples(input, 0)));
  }
  return VagueStribeck({fall, std::sqrt(variance), answer.Deviation(kLugreLogVs)},
                       input.measurements, SteadySamples(input, 0));
}

/// A positive parameter with the interval of its logarithm.
EstimatedParameter Positive(const ParameterInfo& info, const Measurements& m, double value,
                            double log_deviation, double freedom) {
  const double factor = std::exp(StudentQuantile(freedom) * log_deviation);
  return {std::string(info.name),
          value,
          UnitFor(info, m),
          std::abs(value) * log_deviation,
          {{std::min(value / factor, value * factor), std::max(value / factor, value * factor)}}};
}

/// Puts values, deviations and intervals into the estimate.
void Report(const Measurements& m, const LugreAnswer& answer, Estimate& estimate) {
  const auto p = LugreValues(answer.fit.solution.x.data());
  const auto& table = LuGre::parameters;
  const double freedom = answer.known.freedom;
  for (size_t i = 0; i <= kLugreStatic; ++i) {
    estimate.parameters.push_back(WithInterval(std::string(table[i].name), p[i],
                                               UnitFor(table[i], m),
                                               answer.Deviation(static_cast<int>(i)), freedom));
  }
  for (const size_t i : {size_t{kLugreLogVs}, size_t{kLugreLogStiffness}}) {
    estimate.parameters.push_back(
        Positive(table[i], m, p[i], answer.Deviation(static_cast<int>(i)), freedom));
  }
  const double damping = p[kLugreDamping];
  if (answer.rows[kLugreDamping] >= 0) {
    estimate.parameters.push_back(Positive(table[kLugreDamping], m, damping,
                                           answer.Deviation(kLugreDamping) / std::abs(damping),
                                           freedom));
  } else {
    estimate.parameters.push_back(
        {std::string(table[kLugreDamping].name), 0, UnitFor(table[kLugreDamping], m), {}, {}});
  }
  if (answer.rows[kLugreInertia] < 0) return;
  estimate.parameters.push_back(
      WithInterval(std::string(kInertiaInfo.name), answer.fit.solution.x[kLugreInertia],
                   UnitFor(kInertiaInfo, m), answer.Deviation(kLugreInertia), freedom));
}

std::vector<TraceEntry> Trace(const LugreProblem& problem, const std::vector<LugrePoint>& scan) {
  std::vector<TraceEntry> trace;
  const auto n = static_cast<double>(problem.deviation.size());
  for (const LugrePoint& point : scan) {
    TraceEntry entry;
    entry.iteration = static_cast<int>(trace.size());
    const auto p = LugreValues(point.x.data());
    for (size_t i = 0; i < p.size(); ++i) {
      entry.parameters.emplace_back(LuGre::parameters[i].name, p[i]);
    }
    entry.rmse = problem.deviation[0] * std::sqrt(point.squares / n);
    trace.push_back(std::move(entry));
  }
  return trace;
}

/// The verdict on a fit, and its numbers where they can be trusted.
Estimate Conclude(const IdentifierInput& input, const LugreProblem& problem,
                  const LugreAnswer& answer, const NoiseOfGroups& noise) {
  if (auto why = VagueBristle(input.measurements, answer)) {
    return Failed(kName, Status::not_identifiable, *why);
  }
  if (auto why = UnknownStribeck(input, answer)) {
    return Failed(kName, Status::not_identifiable, *why);
  }
  const LugreFit& fit = answer.fit;
  if (!fit.converged) {
    return Failed(kName, Status::not_converged,
                  "the fit still moves after 100 iterations; " +
                      WhyUnsettled(input.measurements, "law stribeck"));
  }

  const Measurements& m = input.measurements;
  Estimate estimate;
  estimate.identifier = kName;
  const Eigen::VectorXd torque = Kept(m.torque, problem.used);
  const auto p = static_cast<int>(answer.known.covariance.rows());
  estimate.metrics =
      ComputeMetrics(torque, torque - fit.residual.cwiseProduct(problem.deviation), p, p);
  Report(m, answer, estimate);
  const Eigen::Index turns = torque.size() - input.selection.count();
  estimate.message = fmt::format(
      "least squares on {} samples{}{}", torque.size(),
      turns > 0 ? fmt::format(", {} of them around turns, where {:.3g} {} rms is left, elsewhere "
                              "{:.3g}",
                              turns, noise.others, m.torque_unit, noise.kept)
                : "",
      ColourOf(answer.known.noise));
  const double friction = torque.norm() / std::sqrt(static_cast<double>(torque.size()));
  if (noise.others > kMissed * noise.kept && noise.others > kNotable * friction) {
    Void(Status::inadequate_model,
         fmt::format("around turns the law leaves {:.3g} {} rms, at constant speeds {:.3g}: it "
                     "misses what happens there; move more softly, log faster, or use the law "
                     "stribeck",
                     noise.others, m.torque_unit, noise.kept),
         estimate);
    return estimate;
  }
  DescribeFriction(*FindLaw(LuGre::name), m, estimate);
  return estimate;
}

Estimate Identify(const IdentifierInput& input) {
  const Measurements& m = input.measurements;
  if (auto why = Unusable(input, kLugreSize + 1)) return Failed(kName, Status::bad_data, *why);

  // the columns of Eq. (2) must be distinct before anything else is thought of
  const Eigen::VectorXd torque = Kept(m.torque, input.selection);
  const Law& sliding = *FindLaw(ViscousCoulomb::name);
  if (SolveLeastSquares(Kept(LawColumns(sliding, m.velocity), input.selection), torque).rank < 2) {
    return Failed(kName, Status::not_identifiable,
                  Indistinct({"viscous", "coulomb", "static", "stribeck_velocity",
                              "bristle_stiffness", "bristle_damping"},
                             m, input.selection));
  }

  const double scale = torque.norm() / std::sqrt(static_cast<double>(torque.size()));
  LugreProblem problem = MakeLugreProblem(input, scale);
  if (input.options.Text("damping") == "none") problem.constant.push_back(kLugreDamping);
  if (input.options.Text("inertia") == "none") problem.constant.push_back(kLugreInertia);
  const std::vector<LugrePoint> scan =
      ScanBristle(problem, m, [&](double distance) { return SteadyStart(input, distance); });
  if (scan.empty()) {
    return Failed(kName, Status::not_identifiable,
                  "static and stribeck_velocity cannot be told from coulomb; " +
                      SlowSpeeds(input.measurements, SteadySamples(input, 0)));
  }

  const std::vector<TraceEntry> trace = Trace(problem, scan);
  LugreFit fit = FitFrom(problem, scan, m.velocity.cwiseAbs().maxCoeff());
  NoiseOfGroups noise;
  for (int pass = 0; pass < kPasses; ++pass) {
    noise = WeighLugre(input.selection, fit, problem);
    fit = RefineLugre(problem, fit.solution);
  }

  Estimate estimate = Conclude(input, problem, JudgeLugre(input, problem, std::move(fit)), noise);
  estimate.trace = trace;
  return estimate;
}

}  // namespace

Identifier LuGreByCeres() {
  return {kName,
          "the LuGre law by least squares over turns and constant speeds; needs no start",
          {{"damping", "estimated", "estimated|none", "bristle_damping, or 0"},
           {"inertia", "estimated", "estimated|none",
            "torque for acceleration, beside the friction, or none"}},
          &Identify,
          Regime::transient};
}

}  // namespace warmjoint::inline identification

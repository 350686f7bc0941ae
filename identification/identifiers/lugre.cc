// Identifier `lugre`: the LuGre law, its bristle included.
//
// (kv, kc, ks, vs, sigma0, sigma1, M) = argmin sum ((tau - F - M a) / s)^2, F the LuGre law, or
// the one with a level for each direction (kc+, kc- and kr for kc and ks), over the recorded motion (bristle_state.h). Starts,
// stops and turns take part in addition to the samples kept, since only they show the bristle (lugre_data.h). M, which acts
// there too, is estimated together with the law, and so is how far the bristle is bent as each recording begins. s is the rms
// of the residual, one value for the samples kept and one for the others, larger for outliers (Huber's weights), from three
// passes. Starts from the Stribeck curve of the samples at constant speed, with sigma0 and sigma1 from a grid; the best three
// are refined by Ceres. Standard deviations and intervals as in uncertainty.h, those of vs, sigma0 and sigma1
// through their logarithms.
//
// not_identifiable where the motion does not determine the law without bristle and fall; where the Stribeck effect is
// not seen (stribeck_verdict.h); where sigma0 or sigma1 are not known to a factor of e. What the
// sampling shifts the parameters by counts as a standard deviation in addition to that of the noise: a third of
// what leaving out every other sample changes (Richardson). inadequate_model where friction rises
// from rest, or turns leave twice as much as constant speeds and 2 % of the torque. The trace
// holds the grid.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/fit/identifier.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/model/normal_equations.h"
#include "identification/nonlinear/lugre_data.h"
#include "identification/nonlinear/lugre_fit.h"
#include "identification/nonlinear/stribeck_fit.h"
#include "identification/nonlinear/stribeck_verdict.h"
#include "identification/sentences/falls.h"
#include "identification/uncertainty/uncertainty.h"
#include "identification/warming/warming_verdict.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

/// A fit with what is known of it.
struct LugreAnswer {
  LugreFit fit;
  /// The uncertainty of the parameters that are not constant. Damping and inertia, which may be constant, are the last, so that
  /// the others have the same places here as in x.
  Uncertainty uncertainty;
};

/// Standard deviation of the residual of the kept samples and of the others, N.m or N.
struct NoiseOfGroups {
  double kept = 0;
  double others = 0;
};

constexpr double kOutlier = 4;  // standard deviations

/// Rms of residuals, those beyond kOutlier robust standard deviations left out. [n]
double RobustRms(std::vector<double> residuals) {
  if (residuals.empty()) return 0;
  // robust standard deviation, by the median size
  Eigen::VectorXd sizes = Eigen::Map<const Eigen::ArrayXd>(
                              residuals.data(), static_cast<Eigen::Index>(residuals.size()))
                              .abs();
  const double most = kOutlier * MedianInPlace(sizes) / 0.6745;
  // root mean square of the others
  double squares = 0, count = 0;
  for (const double residual : residuals) {
    if (std::abs(residual) > most) continue;
    squares += residual * residual;
    count += 1;
  }
  return std::sqrt(squares / std::max(count, 1.0));
}

/// By how much the sampling shifts the parameters: linear motion between samples has an error that grows with the
/// square of the interval, so that the error is a third of what leaving out every other sample
/// changes (Richardson). jacobian: [n x d] of the free parameters, over the deviations.
Eigen::VectorXd SamplingShift(const IdentifierInput& input, const LugreProblem& problem,
                              const LugreFit& fit, const Eigen::MatrixXd& jacobian) {
  const HalvedProblem halved = Halve(input, problem);
  const Eigen::VectorXd full = LugreTorque(problem, fit);
  const Eigen::VectorXd half = LugreTorque(halved.problem, fit);
  // rows of the samples in the Jacobian
  std::vector<Eigen::Index> row(static_cast<size_t>(full.size()), -1);
  Eigen::Index rows = 0;
  for (Eigen::Index i = 0; i < full.size(); ++i) {
    if (problem.used.keep[i]) row[static_cast<size_t>(i)] = rows++;
  }

  const Eigen::Index n = halved.problem.used.count();
  Eigen::MatrixXd J(n, jacobian.cols());
  // shift of the torque in deviations, where both grids use the sample
  Eigen::VectorXd error(n);
  Eigen::Index k = 0;
  for (size_t j = 0; j < halved.samples.size(); ++j) {
    const Eigen::Index i = halved.samples[j], r = row[static_cast<size_t>(i)];
    if (r < 0) continue;
    J.row(k) = jacobian.row(r);
    error[k++] = (half[static_cast<Eigen::Index>(j)] - full[i]) / (3 * problem.deviation[r]);
  }
  // the shift of the parameters, by least squares
  return Cofactor(GramOf(J)) * (J.transpose() * error);
}

/// Weighs both groups of samples by the residuals of a fit, and outliers as Huber (1964) does:
/// where the drive's torque jumps, the acceleration between samples is not known.
NoiseOfGroups WeighLugre(const Selection& selection, const LugreFit& fit, LugreProblem& problem) {
  // residuals at constant speed, and others
  const Eigen::VectorXd residual = fit.residual.cwiseProduct(problem.deviation);
  std::vector<double> kept, others;
  Eigen::Index row = 0;
  for (Eigen::Index i = 0; i < problem.used.keep.size(); ++i) {
    if (problem.used.keep[i]) (selection.keep[i] ? kept : others).push_back(residual[row++]);
  }
  NoiseOfGroups noise;
  noise.kept = RobustRms(kept);
  // a handful of samples does not determine the noise
  const bool few = static_cast<Eigen::Index>(others.size()) < 3 * problem.places().size();
  noise.others = few ? noise.kept : RobustRms(others);
  // each sample has the noise of its group, an outlier a larger one
  const double least = 1e-12 * problem.torque.cwiseAbs().maxCoeff();
  row = 0;
  for (Eigen::Index i = 0; i < problem.used.keep.size(); ++i) {
    if (!problem.used.keep[i]) continue;
    const double deviation = std::max(selection.keep[i] ? noise.kept : noise.others, least);
    problem.deviation[row] = std::max(deviation, std::abs(residual[row]) / kOutlier);
    ++row;
  }
  return noise;
}

/// Covariance of the parameters that are not constant: noise and, as if it were one standard
/// deviation, what the sampling shifts them by.
LugreAnswer JudgeLugre(const IdentifierInput& input, const LugreProblem& problem, LugreFit fit) {
  LugreAnswer answer;
  // a parameter that is held has no row among the errors
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < problem.places().size(); ++i) {
    if (!problem.IsConstant(i)) free.push_back(i);
  }
  const Eigen::MatrixXd jacobian = fit.jacobian(Eigen::all, free);
  answer.uncertainty = CovarianceOf({.rows = RowsFrom([&] { return jacobian; }),
                                     .cofactor = Cofactor(GramOf(jacobian)),
                                     .residual = fit.residual,
                                     .selection = problem.used});
  // the sampling's error in addition to that of the noise
  const Eigen::VectorXd shift = SamplingShift(input, problem, fit, jacobian);

  answer.uncertainty.covariance += shift * shift.transpose();
  answer.fit = std::move(fit);
  return answer;
}

constexpr const char* kName = "lugre";
constexpr double kExponent = 2;            // of the fall
constexpr int kPasses = 3;                 // of weighing the samples
constexpr double kNotable = 0.02;          // of the torque's rms
constexpr double kMissed = 2;              // rms around turns over that at constant speeds
constexpr double kImpreciseBristle = 0.5;  // standard deviation of a logarithm: a factor of e
constexpr double kNothingKnown = 2.35;     // the same: a factor of 100

/// x with law and ln vs of the Stribeck curve and 0 else, as if presliding were over after `distance`, rad or m;
/// nothing where the samples do not show a curve. It is only a start, so that ks is kept within 1 and 3 kc.
std::optional<Eigen::VectorXd> SteadyStart(const IdentifierInput& input, const FallingLaw& law,
                                           double distance) {
  const LogSamples& m = input.measurements;
  const Selection steady = SteadySamples(input, distance);
  if (steady.count() < 8) return std::nullopt;

  // the curve over the speed without warming, at the best vs of a scan
  const StribeckProblem problem{m, steady, kExponent, PartFit::none, FindFallingLaw(law.steady)};
  const std::vector<FitPoint> scan = ScanStribeckVelocity(problem);
  if (scan.empty()) return std::nullopt;

  // a start needs a level that brakes, and a likely one at rest
  const FallingPlaces from = problem.places(), at = law.places;
  Eigen::VectorXd levels = from.law().Of(scan[0].x);
  if (!(law.coulomb(levels.data()) > 0)) return std::nullopt;
  law.keep(levels.data(), 1, 3);
  Eigen::VectorXd start = Eigen::VectorXd::Zero(at.size());
  at.law().In(start) = levels;
  start[at.log_vs()] = scan[0].x[from.log_vs()];
  return start;
}

/// The best of the refined starts. The first may have missed the fall of the Stribeck curve, which
/// few samples show: it is looked for again once the bristle is known.
LugreFit FitFrom(const LugreProblem& problem, const std::vector<FitPoint>& scan, double fastest) {
  const auto refine = [&](const FitPoint& start) { return RefineLugre(problem, start); };
  const LugreFit first = BestRefined(scan, refine);
  // levels may have diverged where the log shows no fall; those of the scan have not
  const Slice law = problem.places().law();
  FitPoint bristle = first.solution;
  law.In(bristle.x) = law.Of(scan[0].x);
  return BestRefined(ScanFall(problem, bristle, fastest), refine, std::optional(first));
}

/// Why bristle_stiffness is not identifiable, or bristle_damping; nothing where they are.
std::optional<std::string> UnidentifiableBristle(const LogSamples& m, const LugreProblem& problem,
                                                 const LugreAnswer& answer) {
  const FallingPlaces& at = problem.places();
  const double stiffness = answer.uncertainty.Deviation(at.log_stiffness());
  if (!(stiffness < kImpreciseBristle)) {
    return stiffness < kNothingKnown ? ExplainVagueStiffness(std::exp(1.96 * stiffness))
                                     : ExplainUnknownStiffness();
  }

  // the damping, where it is estimated
  if (problem.IsConstant(at.damping())) return std::nullopt;
  const Eigen::VectorXd& x = answer.fit.solution.x;
  const double damping = x[at.damping()], deviation = answer.uncertainty.Deviation(at.damping());
  if (deviation < kImpreciseBristle * std::abs(damping)) return std::nullopt;
  const double bend = problem.law->at_rest(at.law().Of(x).data()) / std::exp(x[at.log_stiffness()]);
  return ExplainUnknownDamping({.value = damping, .deviation = deviation, .bend = bend}, m.joint);
}

/// Why the level at rest and stribeck_velocity are not identifiable; nothing where they are.
std::optional<std::string> UnknownStribeck(const IdentifierInput& input,
                                           const LugreProblem& problem, const LugreAnswer& answer) {
  const StribeckEvidence evidence =
      EvidenceOf(*problem.law, problem.places(), answer.fit.solution.x, answer.uncertainty);

  // the fall must exceed its own standard error
  const double explained = std::pow(evidence.fall / evidence.fall_deviation, 2);
  if (!(explained > kVisibleWarming)) {
    return ExplainSmallFall(problem.law->fall_words, std::sqrt(std::max(explained, 0.0)),
                            std::sqrt(kVisibleWarming),
                            SlowSpeeds(input.measurements, SteadySamples(input, 0)));
  }
  return UnidentifiableStribeck(*problem.law, evidence, input.measurements,
                                SteadySamples(input, 0));
}

/// Law and, where it is estimated, inertia at a point: the model and its table.
void SetModel(const LogSamples& m, const LugreProblem& problem, const Eigen::VectorXd& x,
              Fit& fit) {
  const FallingPlaces& at = problem.places();
  SetFallingModel(*problem.law, kExponent, at, x, m, fit);
  // the stiffness is fitted by its logarithm, the damping by its value
  fit.parameters[at.log_stiffness()].coordinate = Coordinate::logarithm;
  Unknown& damping = fit.parameters[at.damping()];
  damping.coordinate = Coordinate::positive;
  damping.estimated = !problem.IsConstant(at.damping());
  if (problem.IsConstant(at.inertia())) return;
  Append({WithValue(InertiaUnknown(UnitsOf(m)), x[at.inertia()])}, fit);
}

/// Why the fit is refused; nothing where it is not.
std::optional<Refusal> WhyRefused(const IdentifierInput& input, const LugreProblem& problem,
                                  const LugreAnswer& answer) {
  auto why = UnidentifiableBristle(input.measurements, problem, answer);
  if (!why) why = UnknownStribeck(input, problem, answer);
  if (why) return Refusal{Status::not_identifiable, *why};
  if (answer.fit.converged) return std::nullopt;
  return NotConverged();
}

/// Invalidates a fit that does not describe the friction around turns.
void JudgeTurns(const LogSamples& m, const NoiseOfGroups& noise, Fit& fit) {
  const double friction =
      fit.rows.torque.norm() / std::sqrt(static_cast<double>(fit.rows.torque.size()));
  if (!(noise.others > kMissed * noise.kept) || !(noise.others > kNotable * friction)) return;
  fit.causes.push_back(
      Invalidate(Status::inadequate_model, ExplainTurns(noise.others, noise.kept, m.torque_unit)));
}

/// Puts an answer into `fit`, or the reason why it is refused.
void Conclude(const IdentifierInput& input, const LugreProblem& problem, const LugreAnswer& answer,
              const NoiseOfGroups& noise, Fit& fit) {
  fit.refusal = WhyRefused(input, problem, answer);
  if (fit.refusal) return;

  // the model, and how well it fits
  const LogSamples& m = input.measurements;
  const FallingPlaces& at = problem.places();
  const Eigen::VectorXd& x = answer.fit.solution.x;
  SetModel(m, problem, x, fit);
  fit.rows.used = problem.used;
  fit.rows.rest = x[at.inertia()] * problem.acceleration;
  // friction with which each recording begins: the load of the bristle and the viscous part
  const double viscous = x[at.law().begin];
  const std::vector<SampleRange> recordings = m.Recordings();
  for (size_t r = 0; r < answer.fit.loads.size(); ++r) {
    const double velocity = problem.motion.velocity(recordings[r].first);
    fit.start.friction.push_back(answer.fit.loads[r] + viscous * velocity);
  }
  fit.rows.torque = Kept(m.torque, fit.rows.used);
  fit.rows.fitted = fit.rows.torque - answer.fit.residual.cwiseProduct(problem.deviation);
  fit.rows.count = static_cast<int>(answer.uncertainty.covariance.rows()) +
                   static_cast<int>(answer.fit.loads.size());
  fit.rows.effective_parameters = fit.rows.count;

  // divided by its deviations, which take up what is uneven, a residual shows only its colour
  Uncertainty uncertainty = answer.uncertainty;
  uncertainty.uneven = 0;
  fit.rows.errors.covariance = [uncertainty] { return uncertainty; };

  const Eigen::Index turns = fit.rows.torque.size() - input.selection.count();
  std::optional<AroundReversals> around;
  if (turns > 0) {
    around = AroundReversals{.samples = turns, .residual = noise.others, .elsewhere = noise.kept};
  }
  fit.summary = SummaryOfBristle({.count = fit.rows.torque.size()}, around, m.torque_unit);
  JudgeTurns(m, noise, fit);
}

struct LuGreOptions {
  FallingLawOf<BristleFallingLaws> law;
  PartFit damping = PartFit::estimated;
  PartFit inertia = PartFit::estimated;

  template <class A>
  void Serialize(A* a) {
    a->Field("law", &law, {.meaning = "one Coulomb level, or one for each direction"});
    a->Field("damping", &damping, {.meaning = "bristle_damping, or 0"});
    a->Field("inertia", &inertia,
             {.meaning = "torque for acceleration, with the friction, or none"});
  }
};

Fit FitLugre(const IdentifierInput& input) {
  const LogSamples& m = input.measurements;
  const auto& options = input.options.Get<LuGreOptions>();
  const FallingLaw& law = *options.law;
  if (auto why = Unusable(input, static_cast<int>(law.levels()) + 5)) {
    return Refused(kName, Status::bad_data, *why);
  }
  if (auto why = UnknownSliding(input, law, law.law.parameters)) return Refused(kName, *why);

  // scan the bristle
  const Eigen::VectorXd torque = Kept(m.torque, input.selection);
  const double scale = torque.norm() / std::sqrt(static_cast<double>(torque.size()));
  LugreProblem problem = MakeLugreProblem(input, law, scale);
  // parameters that the options hold at 0 are not estimated
  if (options.damping == PartFit::none)
    problem.constant.push_back(static_cast<int>(problem.places().damping()));
  if (options.inertia == PartFit::none)
    problem.constant.push_back(static_cast<int>(problem.places().inertia()));
  const std::vector<FitPoint> scan =
      ScanBristle(problem, m, [&](double distance) { return SteadyStart(input, law, distance); });
  if (scan.empty()) return Refused(kName, NoFall(law, m, SteadySamples(input, 0)));
  Fit fit;
  fit.identifier = kName;
  fit.trace = ScanTrace(law, kExponent, scan, problem.deviation[0], problem.deviation.size());
  SetModel(m, problem, scan[0].x, fit);

  // refine the best, and weigh the samples by its residuals
  LugreFit best = FitFrom(problem, scan, m.velocity.cwiseAbs().maxCoeff());
  NoiseOfGroups noise;
  for (int pass = 0; pass < kPasses; ++pass) {
    noise = WeighLugre(input.selection, best, problem);
    best = RefineLugre(problem, best.solution);
  }
  Conclude(input, problem, JudgeLugre(input, problem, std::move(best)), noise, fit);
  return fit;
}

}  // namespace

Identifier LuGreIdentifier() {
  return {kName, "the LuGre law by least squares over turns and constant speeds; needs no start",
          LuGreOptions{}, &FitLugre, View::raw};
}

}  // namespace warmjoint

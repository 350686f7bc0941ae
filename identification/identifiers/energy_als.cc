// Identifier `energy-als`: Algorithm 1 of the paper, which are alternating least squares.
//
// Alternating least squares, a block-coordinate descent on |tau - Fn(v) - sign(v) E|^2 with
// E = H W, W = |tau v| (19):
//   0. E from the start H0, Fn by (24); then repeat
//   1. E by (23)   2. H(z) of (22) to that E by output error   3. E = H W   4. Fn by (24).
// It converges linearly, at the squared largest canonical correlation of its two blocks: about
// 0.974 an iteration for steady motion, faster where rests let the joint cool. not_converged,
// with the numbers reached so far, where the observed rate says that a parameter would still change
// by more than the option `tolerance`.
// It gives no intervals: W is formed of the noisy torque, so the residual understates the errors
// (on Table I such intervals would hold the time constant in 72 % of the runs instead of 95 %).

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "identification/alternating/block_descent.h"
#include "identification/alternating/first_guess.h"
#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"
#include "identification/maps/identify_maps.h"
#include "identification/maps/local_rows.h"
#include "identification/model/least_squares.h"
#include "identification/model/normal_equations.h"
#include "identification/sentences/fit.h"
#include "identification/sentences/friction.h"
#include "identification/sentences/heat.h"
#include "identification/sentences/maps.h"
#include "identification/table.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

/// Judgement of a sequence that converges linearly, x[i+1] - x* = rate (x[i] - x*).
struct Convergence {
  double rate = 1;       // observed, over the last changes; 1 where none can be seen
  double remaining = 0;  // |x[n] - x*|, extrapolated: |x[n] - x[n-1]| rate / (1 - rate)
};

constexpr size_t kLastChanges = 5;  // over which the rate is observed
constexpr double kStill = 1e-9;     // a change that the stopping rules inside explain

constexpr const char* kName = "energy-als";
// of the joint Jacobian; above it the intervals show what is uncertain
constexpr double kSingular = 1e-6;

enum class LoopStart { options, guess, random };
std::span<const Word<LoopStart>> WordsOf(LoopStart) {
  static constexpr std::array words{Word{"options", LoopStart::options},
                                    Word{"guess", LoopStart::guess},
                                    Word{"random", LoopStart::random}};
  return words;
}

struct EnergyAlsOptions {
  int iterations = 50;
  LoopStart start = LoopStart::options;
  double start_gain = -0.1;          // N.m/W or N/W
  double start_time_constant = 600;  // s
  OptionRange gain_range{-9, 0};     // N.m/W or N/W
  OptionRange time_range{0, 1800};   // s
  double tolerance = 0.01;

  template <class A>
  void Serialize(A* a) {
    a->Field("iterations", &iterations,
             {.bounds = {.at_least = 0}, .meaning = "iterations of the loop"});
    a->Field("start", &start,
             {.meaning = "start_gain and start_time_constant, the torque's envelope (25), or drawn "
                         "evenly"});
    a->Field("start_gain", &start_gain, {.meaning = "first thermal gain, N.m/W or N/W"});
    a->Field("start_time_constant", &start_time_constant,
             {.bounds = {.above = 0}, .meaning = "first time constant, s"});
    a->Field("gain_range", &gain_range,
             {.meaning = "where a random first gain is drawn, N.m/W or N/W"});
    a->Field("time_range", &time_range,
             {.meaning = "where a random first time constant is drawn, s"});
    a->Field(
        "tolerance", &tolerance,
        {.bounds = {.above = 0},
         .meaning = "largest distance from the fixed point that counts as converged, relative"});
  }
};

/// Whether there is a map in addition to the law.
enum class NominalMap { none, map };
std::span<const Word<NominalMap>> WordsOf(NominalMap) {
  static constexpr std::array words{Word{"none", NominalMap::none}, Word{"map", NominalMap::map}};
  return words;
}

/// A map in addition to the law, and how it is made.
struct NominalMapOptions : AddedMapOptions {
  NominalMap position = NominalMap::none;

  template <class A>
  void Serialize(A* a) {
    a->Field("position", &position, {.meaning = "a map over position in addition to the law"});
    AddedMapOptions::Serialize(a);
  }
};

/// What Eq. (24) fits: a nominal law, with gravity or with a map over position in addition.
struct NominalPart {
  Selection moving;         // samples that take part: kept, and not at rest
  RigidPart gravity;        // none where there is a map
  Eigen::MatrixXd columns;  // [N x p] over all samples: law (d), then gravity or kernels (q)
  /// [p x p] (A^T A + s P)^-1 over the samples in motion; P: 1 on the kernels' diagonal.
  Eigen::MatrixXd cofactor;
  Eigen::VectorXd solution;        // [p] the fit without warming
  std::vector<FrictionMap> maps;   // shapes
  double strength = 0;             // s
  double effective = 0;            // of the p parameters
  std::optional<Refusal> refusal;  // why there is no such part

  // the places of the p columns; the heat's two follow them in the fit
  Slice law() const { return {0, columns.cols() - gravity.count() - KernelCount(maps)}; }
  Slice rigid() const { return {law().end(), gravity.count()}; }
  Slice weights() const { return {rigid().end(), KernelCount(maps)}; }
};

/// Law and kernels over position.
void AddMap(const IdentifierInput& input, NominalPart& part) {
  // a map over position would take gravity up
  if (input.options.Get<GravityOption>().gravity != FittedGravity::none) {
    part.refusal = Refusal{Status::bad_data, kMapBesideGravity};
    return;
  }
  // law and map over samples in motion, without any warming
  const IdentifierInput moving = input.With(part.moving);
  MapBeginning begin = BeginMaps(moving, kName, {MapQuantity::position});
  part.refusal = begin.refusal;
  if (part.refusal) return;
  MapTask& task = begin.task;
  task.candidates = PositionMaps(input.options, begin.points);
  const auto choice = ChooseAndFit(moving, task);
  if (!choice) {
    part.refusal = Unsolvable();
    return;
  }
  // kernels join the law as further columns
  part.maps = choice->fit.maps;
  const MapPoints all = PointsOf(input.measurements);
  part.columns = ConcatColumns(part.columns, DenseKernels(part.maps, all, 0, all.rows()));
  part.cofactor = choice->fit.inverse;
  part.solution = choice->fit.x;
  part.strength = choice->fit.strength;
  part.effective = choice->fit.effective;
}

/// As the options law, gravity and position ask for it. The map's shape and strength are chosen on
/// the torque as it is, warming included.
NominalPart PrepareNominalPart(const IdentifierInput& given) {
  // law and gravity, on enough samples for gain and time constant too
  LinearTask task = BeginLinear(given, 2);
  NominalPart part;
  part.gravity = task.gravity;
  part.refusal = task.refusal;
  if (part.refusal) return part;

  // samples in motion
  const IdentifierInput input = part.gravity.Of(given);
  part.moving = WithoutRest(input.selection, input.measurements);
  part.columns = task.columns;
  if (given.options.Get<NominalMapOptions>().position == NominalMap::map) {
    AddMap(input, part);
    return part;
  }

  // the columns of Fn and G must be distinct before a warming is fitted
  LeastSquares fit = SolveLinear(input.With(part.moving), task);
  part.refusal = task.refusal;
  // the nominal fit, without warming
  part.cofactor = std::move(fit.cofactor);
  part.solution = std::move(fit.solution);
  part.effective = task.count();
  return part;
}

/// Where the loop starts: from the options, from (25) corrected, or drawn at random.
FirstGuess Start(const IdentifierInput& input) {
  const auto& options = input.options.Get<EnergyAlsOptions>();
  if (options.start == LoopStart::guess) return GuessThermal(input.measurements, input.selection);
  if (options.start == LoopStart::options) {
    return {Thermal{options.start_gain, options.start_time_constant}, ""};
  }

  // drawn evenly within the ranges of the options
  StartStream random(input.start);
  const auto [least_gain, greatest_gain] = options.gain_range;
  const auto [shortest, longest] = options.time_range;
  const double gain = random.Uniform(least_gain, greatest_gain);
  return {Thermal{gain, random.Uniform(shortest, longest)}, ""};
}

/// (nominal, gain, ln tau): the parameters in which the covariance is known.
Eigen::VectorXd Vector(const DescentState& state) {
  const Eigen::Index d = state.nominal.size();
  Eigen::VectorXd x(d + 2);
  x << state.nominal, state.thermal.gain, std::log(state.thermal.time_constant);
  return x;
}

/// All iterations, the start included.
std::vector<DescentState> Descend(const BlockDescent& descent, const Thermal& start,
                                  int iterations) {
  std::vector<DescentState> states{descent.Start(start)};
  for (int i = 0; i < iterations; ++i) {
    DescentState from = states.back();
    // the first fit of H begins at the best time constant of a grid
    if (i == 0) from.thermal.time_constant = descent.ScanFrom(from);
    states.push_back(descent.Next(from));
  }
  return states;
}

/// Distance to the fixed point, each parameter relative to its value or, where that is smaller, to
/// its standard deviation; tau by its logarithm, which is relative already. Distances are the largest over the
/// parameters. Infinite where the sequence does not approach anything, or is too short (fewer than 3) to judge.
Convergence Judge(const std::vector<DescentState>& states, const Eigen::VectorXd& deviations) {
  if (states.size() < 3) return {1, kInfinity};
  Eigen::VectorXd scale = Vector(states.back()).cwiseAbs().cwiseMax(deviations);
  scale.tail(1).setOnes();
  const auto change_to = [&](size_t i) {
    const Eigen::VectorXd after = Vector(states[i]).cwiseQuotient(scale);
    const Eigen::VectorXd before = Vector(states[i - 1]).cwiseQuotient(scale);
    return (after - before).cwiseAbs().maxCoeff();
  };
  const size_t last = states.size() - 1;
  const double change = change_to(last);
  if (change < kStill) return {0, 0};

  // change[n] = rate^m change[n - m]
  const size_t span = std::min(kLastChanges, last - 1);
  const double rate = std::pow(change / change_to(last - span), 1.0 / static_cast<double>(span));
  if (!(rate < 1)) return {1, kInfinity};
  return {rate, change * rate / (1 - rate)};
}

/// Why the last state is refused; nothing where it is not. friction: fitted, [N] N.m or N.
std::optional<Refusal> WhyRefused(const LogSamples& m, const DescentState& last,
                                  const Eigen::VectorXd& friction) {
  if (!last.inside) {
    return Refusal{Status::not_identifiable,
                   ExplainLongestTimeConstant(last.thermal.time_constant)};
  }
  // the first kept sample whose fitted friction drives the joint instead of braking it
  for (Eigen::Index i = 0; i < friction.size(); ++i) {
    if (!DrivesJoint(m.velocity[i], friction[i])) continue;
    return Refusal{Status::inadequate_model,
                   ExplainDriving(m.time[i], RemedyForNonDissipative(""))};
  }
  return std::nullopt;
}

/// Whether the loop has converged, and a sentence about it.
std::pair<bool, std::string> Arrival(const std::vector<DescentState>& states,
                                     const Uncertainty& uncertainty, double tolerance) {
  const Convergence distance = Judge(states, uncertainty.covariance.diagonal().cwiseSqrt());
  const size_t iterations = states.size() - 1;
  if (distance.remaining <= tolerance) {
    return {true, ExplainArrived(iterations, distance.rate, distance.remaining)};
  }
  return {false, ExplainStopped(iterations, distance.rate, distance.remaining, tolerance)};
}

/// (J^T J + s P)^-1 of both blocks together; nothing where the motion cannot distinguish them.
/// jacobian: [n x (p + 2)]
std::optional<Eigen::MatrixXd> JointCofactor(const NominalPart& part,
                                             const Eigen::MatrixXd& jacobian,
                                             const Eigen::VectorXd& torque) {
  // without maps the columns themselves show whether they are distinct
  if (part.maps.empty()) {
    const LeastSquares joint = SolveLeastSquares(jacobian, torque, kSingular);
    if (joint.rank < jacobian.cols()) return std::nullopt;
    return joint.cofactor;
  }

  // with kernels the strength of their prior joins the normal equations
  Eigen::MatrixXd normal = GramOf(jacobian);
  const Slice weights = part.weights();
  normal.diagonal().segment(weights.begin, weights.size).array() += part.strength;
  const Eigen::MatrixXd cofactor = Cofactor(normal);
  if (!cofactor.allFinite()) return std::nullopt;
  return cofactor;
}

/// What is known of the rows of the table, law, warming and gravity. uncertainty: of (nominal, gain, ln tau).
Uncertainty OfTable(const NominalPart& part, Uncertainty uncertainty) {
  // the fit has gravity before the warming, the table after it
  std::vector<Eigen::Index> order;
  for (const Slice& at : {part.law(), Slice{part.weights().end(), 2}, part.rigid()}) {
    for (Eigen::Index i = at.begin; i < at.end(); ++i) order.push_back(i);
  }
  return Picked(std::move(uncertainty), order);
}

/// Law, warming, gravity and maps of the last state: the model and its table.
Fit ModelOf(const IdentifierInput& input, const NominalPart& part, const DescentState& last) {
  const LogSamples& m = input.measurements;
  const Law& law = *input.options.Get<LawOption>().law;
  const Eigen::VectorXd values = part.law().Of(last.nominal);
  Fit fit;
  fit.identifier = kName;
  fit.model.friction = FrictionOf(law, values, m);
  fit.model.friction.thermal = last.thermal;
  fit.model.friction.maps = WithWeights(part.maps, part.weights().Of(last.nominal));
  fit.parameters = WithValues(LawUnknowns(law, values.size(), UnitsOf(m)), values);
  Append(HeatParameters(last.thermal, m), fit);
  AddRigid(part.gravity, part.rigid().Of(last.nominal), m, fit);
  return fit;
}

/// The fit that the last state makes, with its verdict.
Fit Conclude(const IdentifierInput& input, const NominalPart& part, const BlockDescent& descent,
             const std::vector<DescentState>& states) {
  const DescentState& last = states.back();
  Fit fit = ModelOf(input, part, last);
  // gravity may drive the joint, friction itself must brake it
  const Eigen::VectorXd fitted = descent.Fitted(last);
  const Eigen::VectorXd gravity_torque = part.moving.keep.cast<double>().matrix().cwiseProduct(
      part.gravity.columns * part.rigid().Of(last.nominal));
  fit.refusal = WhyRefused(input.measurements, last, fitted - gravity_torque);
  if (fit.refusal) return fit;

  // both blocks together
  fit.rows.used = part.moving;
  fit.rows.torque = Kept(input.measurements.torque, part.moving);
  const Eigen::MatrixXd jacobian = Kept(descent.Jacobian(last), part.moving);
  const auto cofactor = JointCofactor(part, jacobian, fit.rows.torque);
  if (!cofactor) {
    fit.refusal = {Status::not_identifiable, kWarmingIsMixed};
    return fit;
  }
  fit.rows.fitted = Kept(fitted, part.moving);
  fit.rows.count = static_cast<int>(part.weights().end() + 2);
  fit.rows.effective_parameters = part.effective + 2;

  // the uncertainty so far, and the distance from the fixed point
  const Uncertainty uncertainty = CovarianceOf({.rows = RowsFrom([&] { return jacobian; }),
                                                .cofactor = *cofactor,
                                                .residual = fit.rows.residual(),
                                                .selection = fit.rows.used,
                                                .fitted = fit.rows.fitted});
  fit.rows.errors.covariance = [of_table = OfTable(part, uncertainty)] { return of_table; };
  const auto [arrived, message] =
      Arrival(states, uncertainty, input.options.Get<EnergyAlsOptions>().tolerance);
  if (!arrived) fit.causes.push_back(Invalidate(Status::not_converged, message));
  fit.summary = message;

  // W is formed of the noisy torque, so the residual understates the errors
  fit.causes.push_back(DropsIntervals(kNoIntervalsInTurn));
  return fit;
}

std::vector<Iterate> Trace(const std::vector<DescentState>& states, Eigen::Index d) {
  std::vector<Iterate> trace;
  for (const DescentState& state : states) {
    Iterate iterate{static_cast<int>(trace.size()), {}, state.rmse};
    iterate.values.assign(state.nominal.begin(), state.nominal.begin() + d);
    iterate.values.push_back(state.thermal.gain);
    iterate.values.push_back(state.thermal.time_constant);
    trace.push_back(std::move(iterate));
  }
  return trace;
}

Fit FitInTurn(const IdentifierInput& input) {
  const NominalPart part = PrepareNominalPart(input);
  if (part.refusal) return Refused(kName, *part.refusal);
  const RigidPart& gravity = part.gravity;

  const FirstGuess start = Start(gravity.Of(input));
  if (!start.thermal) return Refused(kName, Status::not_identifiable, start.why);

  // all iterations, on losses without gravity, which the fit without warming gives
  const BlockDescent descent(input.measurements, part.moving, part.columns, part.cofactor,
                             gravity.columns * part.rigid().Of(part.solution));
  const std::vector<DescentState> states =
      Descend(descent, *start.thermal, input.options.Get<EnergyAlsOptions>().iterations);

  Fit fit = Conclude(input, part, descent, states);
  fit.trace = Trace(states, static_cast<Eigen::Index>(fit.model.friction.parameters.size()));
  return fit;
}

}  // namespace

Identifier EnergyAls() {
  return {
      kName,
      "alternating least squares (Algorithm 1): energy filter and nominal law fitted in turn, a "
      "trace per iteration",
      OptionGroups<LawOption, EnergyAlsOptions, GravityOption, NominalMapOptions>{},
      &FitInTurn,
      View::constant_speed,
      "energy-em"};
}

}  // namespace warmjoint

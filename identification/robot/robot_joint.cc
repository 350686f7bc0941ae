#include "identification/robot/robot_joint.h"

#include <warmjoint/robot_estimate.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/holdout/hold_out.h"
#include "identification/model/normal_equations.h"
#include "identification/robot/find_heat.h"
#include "identification/robot/joint_fields.h"
#include "identification/uncertainty/tails.h"
#include "models/friction/parameter_rows.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kGainStep = .5;  // of the log gain in one iteration: a factor of 1.6
/// Load-dependent friction over load: gears lose some per cent of what they carry, bad ones a fifth. Where a joint carries
/// nothing, the prior determines it.
constexpr double kLoadSpread = .2;
/// Ripple against the joint's Coulomb friction: harmonics of good gears reach some per cent of it, of bad ones a fifth.
constexpr double kRippleShare = .2;
/// Difference of the Coulomb friction of both directions over its mean, a standard deviation. Why a tenth: of a gear's two flanks, which are cut and
/// polished alike, as of nine joints of UR5, UR10, TX40 and Tiago whose torque has no offset.
constexpr double kFlanks = .1;
/// Deviations of that beyond which a difference is an offset of the torque.
constexpr double kBeyondFlanks = 3;
/// A direction of the description of which the log tells: by whose error in the torque its variance falls by a tenth at least.
constexpr double kTold = .1;
/// Share of the log, at its end, that a further mechanism has to predict.
constexpr double kUnseen = .4;

JointUnits UnitsOf(const JointColumns& c) { return {c.kind, c.torque_unit}; }

/// An unknown with a prior about 0, which reports leave out.
Unknown Nuisance(Role role, double deviation) {
  Unknown row;
  row.role = role;
  row.prior = Normal{0, deviation};
  return row;
}

/// An offset of the torque, which is not friction.
Unknown OffsetUnknown(const JointUnits& units) {
  return {.name = std::string(kTorqueOffset), .role = Role::offset, .unit = units.torque};
}

/// Columns of the law over the samples. [N x 3], and one more where friction rises at low speed
SharedColumns LawColumnsOf(const JointColumns& c, std::optional<Index> slow) {
  ModelRows::Rows columns(c.velocity.size(), slow ? 4 : 3);
  columns.leftCols(3) << c.velocity, c.forwards, -c.backwards;
  if (slow) columns.col(3) = c.slow.col(*slow);
  return std::make_shared<const ModelRows::Rows>(std::move(columns));
}

/// The same as the losses follow from them: as the joint moves, not as the filter of the torque shows it, so that all brake.
SharedColumns LossColumnsOf(const JointColumns& c, std::optional<Index> slow) {
  ModelRows::Rows columns(c.velocity.size(), slow ? 4 : 3);
  columns.leftCols(3) << c.velocity.cwiseAbs().cwiseProduct(c.sign), c.sign.cwiseMax(0.0),
      c.sign.cwiseMin(0.0);
  if (slow) columns.col(3) = c.slow.col(*slow).cwiseAbs().cwiseProduct(c.sign);
  return std::make_shared<const ModelRows::Rows>(std::move(columns));
}

/// What a model without heat has in addition to what all have.
struct Further {
  double ripple = 1;               // level of friction, of which the ripple is a share; N.m or N
  std::optional<double> flanks{};  // how alike both are, where the torque has an offset; N.m or N
  std::optional<Index> slow{};     // of kSlowShares, of a friction that rises at low speed
};

/// Adds a joint's blocks to a model without heat.
void AddBlocks(const JointColumns& c, const GainGuess& guess, const JointQuestion& q,
               const Further& further, JointFit& fit) {
  const std::optional<Index>& slow = further.slow;
  Model& model = fit.model;
  model.samples = c.velocity.size();
  std::vector<Unknown> law;
  const JointUnits units = UnitsOf(c);
  for (const ParameterInfo& info : {kViscousRow, kCoulombPositiveRow, kCoulombNegativeRow}) {
    law.push_back(UnknownOf(info, Role::law, units));
  }
  if (slow) {
    law.push_back(UnknownOf(kStaticRiseRow, Role::law, units));
    fit.slow_share = kSlowShares.at(static_cast<std::size_t>(*slow));
  }
  model.Append(law);
  Unknown load = LoadUnknown(units);
  load.prior = Normal{0, kLoadSpread};
  model.Append({load});
  // an error of the description's own may be negative
  Unknown rotor = InertiaUnknown(units);
  rotor.name = "rotor_inertia";
  rotor.lower = -kInfinity;
  model.Append({rotor});

  // the rigid part, its gain about that of the robot's other joints
  const GainPrior prior = PriorOfGain(c, guess, q.middle_gain);
  const double start = guess.IsSure() ? std::abs(guess.value) : prior.middle;
  const double sign = guess.IsSure() && guess.value < 0 ? -1 : 1;
  model.Append({{.name = "gain",
                 .role = Role::scale,
                 .unit = c.torque_unit + "/(" + std::string(kTorqueUnit.For(c.kind)) + ")",
                 .coordinate = Coordinate::logarithm,
                 .value = sign * start,
                 .prior = Normal{std::log(prior.middle), q.gain_spread.value_or(prior.spread)},
                 .largest_step = kGainStep}});
  const Unknown direction = Nuisance(Role::direction, 1);
  model.Append(
      std::vector<Unknown>(static_cast<std::size_t>(c.rigid.directions.cols()), direction));
  const Unknown harmonic = Nuisance(Role::ripple, kRippleShare * further.ripple);
  const Slice ripple =
      model.Append(std::vector<Unknown>(static_cast<std::size_t>(c.ripple.cols()), harmonic));

  const Slice of_law = fit.At(Role::law);
  model.blocks = {
      std::make_shared<FrictionBlock>(of_law, LawColumnsOf(c, slow), LossColumnsOf(c, slow)),
      std::make_shared<LoadBlock>(fit.At(Role::load).begin, fit.Given(), c.carried,
                                  LoadBlock::Directions{c.Direction(), c.sign}),
      std::make_shared<LinearBlock>(fit.At(Role::inertia), Shared(c.acceleration)),
      std::make_shared<GivenBlock>(fit.Given(), c.rigid),
  };
  if (ripple.size > 0) {
    model.blocks.push_back(std::make_shared<LinearBlock>(ripple, Shared(c.ripple)));
  }
  if (further.flanks) {
    model.groups = {Alike(of_law.begin + 1, of_law.begin + 2, *further.flanks)};
    const Slice offset = model.Append({OffsetUnknown(units)});
    const VectorXd ones = VectorXd::Ones(c.velocity.size());
    model.blocks.push_back(std::make_shared<LinearBlock>(offset, Shared(ones)));
  }
}

void AddHeat(const JointColumns& c, const HeatGuess& guess, JointFit& fit) {
  std::vector<Unknown> heat = HeatUnknowns(UnitsOf(c));
  heat[0].value = guess.gain;
  heat[1].value = guess.time_constant;
  heat[1].largest_step = .5;
  const Slice at = fit.model.Append(heat);
  // the speed in the direction in which the joint moves
  const VectorXd moved = c.velocity.cwiseAbs().cwiseProduct(c.sign);
  fit.model.heat = HeatLoop{.loop = std::make_shared<const ClosedLoop>(
                                c.samples.time, moved, MatrixXd(moved.size(), 0), c.samples.starts),
                            .direction = c.Direction(),
                            .friction = fit.Given().z.end(),
                            .parameters = at};
}

/// Solves first with the description as it is, while the noise is not known, then with all unknowns free.
void SolveFresh(const JointColumns& c, JointFit& fit) {
  const std::vector<Index> of_description = fit.At(Role::direction).Places();
  fit.solved = Solve(fit.model, c.samples, fit.model.Start(), of_description);
  fit.solved = Solve(fit.model, c.samples, fit.solved.x);
}

/// The mean level, from a fit without ripple. The spread of the ripple's prior is a share of it.
double LevelOf(const JointColumns& c, const GainGuess& guess, const JointQuestion& q) {
  JointFit first;
  JointColumns plain = c;
  plain.ripple.resize(c.ripple.rows(), 0);
  AddBlocks(plain, guess, q, {}, first);
  SolveFresh(c, first);
  const Index law = first.At(Role::law).begin;
  const double mean = (first.Value(law + 1) + first.Value(law + 2)) / 2;
  return std::max(mean, std::sqrt(first.solved.noise.variance));
}

/// (J^T J + P)^-1, P by the noise of as many samples as are independent, by which the fit weighed its rows.
MatrixXd PenalisedCofactor(const Model& model, const SolvedModel& solved) {
  return InverseScaled(solved.gram + solved.noise.scale() * model.PriorPrecision());
}

/// How sure the unknowns of a fit are. cofactor: PenalisedCofactor
Uncertainty UncertaintyOf(const Model& model, const ModelSamples& samples,
                          const SolvedModel& solved, const MatrixXd& cofactor) {
  const Selection used{samples.keep, {}};
  const KeptRows rows(model, solved.x, samples.keep);
  const double scale = solved.noise.scale();
  const VectorXd residual = Kept(solved.residual, used);
  return CovarianceOf({.rows = [&](Index first, Index last) { return rows.Between(first, last); },
                       .cofactor = cofactor,
                       .residual = residual,
                       .selection = used,
                       .fitted = Kept(samples.torque, used) - residual,
                       .prior = scale * model.PriorPrecision(),
                       .prior_variance = scale});
}

void AddErrors(const JointColumns& c, JointFit& fit) {
  const MatrixXd cofactor = PenalisedCofactor(fit.model, fit.solved);
  fit.uncertainty = UncertaintyOf(fit.model, c.samples, fit.solved, cofactor);
  fit.effective_parameters = (cofactor * fit.solved.gram).trace();
}

/// The model in all parts but heat, fitted.
JointFit FitCold(const JointColumns& c, const GainGuess& guess, const JointQuestion& q,
                 const Further& further) {
  JointFit fit;
  AddBlocks(c, guess, q, further, fit);
  SolveFresh(c, fit);
  AddErrors(c, fit);
  return fit;
}

/// The same with friction that rises at low speed, from the fit without on.
JointFit FitSlow(const JointColumns& c, const GainGuess& guess, const JointQuestion& q,
                 const Further& further, const JointFit& cold) {
  JointFit fit;
  AddBlocks(c, guess, q, further, fit);
  const Index rise = fit.At(Role::law).end() - 1, size = cold.solved.x.size();
  VectorXd x = VectorXd::Zero(size + 1);
  x.head(rise) = cold.solved.x.head(rise);
  x.tail(size - rise) = cold.solved.x.tail(size - rise);
  fit.solved = Solve(fit.model, c.samples, x);
  AddErrors(c, fit);
  return fit;
}

/// The same fit with one more block at the end of the table.
void SolveOn(const JointColumns& c, JointFit& fit) {
  VectorXd x = fit.model.Start();
  x.head(fit.solved.x.size()) = fit.solved.x;
  fit.solved = Solve(fit.model, c.samples, x);
}

/// By how many times its prior the description is wrong, as the log has it: the root of z^T (I - C)^-1 z over the number of directions
/// that the log tells of, C the covariance of z, since the estimate of a z ~ N(0, 1) has the variance I - C. 1 where chance explains it.
double DescriptionErrorOf(const JointFit& fit, const JointQuestion& q) {
  const Slice at = fit.At(Role::direction);
  if (at.size == 0) return 1;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> told(MatrixXd::Identity(at.size, at.size) -
                                                     at.Block(fit.uncertainty.covariance));
  const VectorXd along = told.eigenvectors().transpose() * at.Of(fit.solved.x);
  double squares = 0, count = 0;
  for (Index i = 0; i < at.size; ++i) {
    if (told.eigenvalues()[i] < kTold) continue;
    squares += along[i] * along[i] / told.eigenvalues()[i];
    ++count;
  }
  if (count == 0) return 1;
  const double p = PValueOfF(squares / count, count, fit.uncertainty.degrees_of_freedom);
  return p < q.error_level / q.joints ? std::max(1.0, std::sqrt(squares / count)) : 1;
}

/// The same fit where friction may drive.
JointFit WithoutBounds(const JointColumns& c, const JointFit& fit) {
  if (fit.solved.at_bound.empty()) return fit;
  JointFit free = fit;
  for (const Index i : fit.solved.at_bound) {
    free.model.table[static_cast<std::size_t>(i)].lower = -kInfinity;
  }
  free.solved = Solve(free.model, c.samples, fit.solved.x);
  AddErrors(c, free);
  return free;
}

/// Deviations that chance does not reach in any of the joints.
double ReachOf(const JointFit& fit, const JointQuestion& q) {
  return StudentQuantile(fit.uncertainty.degrees_of_freedom, 1 - q.error_level / q.joints);
}

/// Rows of the law that the data put beyond their bound, beyond chance over all joints.
void FindBeyond(const JointColumns& c, const JointQuestion& q, JointFit& fit) {
  if (fit.fields) {
    // what is within chance is at its bound
    for (const Unknown& row : fit.fields->fit.parameters) {
      if (row.role == Role::law && row.value < row.lower) fit.beyond.push_back(row.name);
    }
    return;
  }
  if (fit.solved.at_bound.empty()) return;
  const JointFit free = WithoutBounds(c, fit);
  const double reach = ReachOf(free, q);
  for (const Index i : fit.solved.at_bound) {
    if (free.Value(i) + reach * free.Deviation(i) >= 0) continue;
    fit.beyond.push_back(fit.model.table[static_cast<std::size_t>(i)].name);
  }
}

/// How alike the Coulomb friction of both directions is, N.m or N, where it differs by more than flanks do, so that the torque has an
/// offset. Motion in both directions tells the difference plus twice the offset alone.
std::optional<double> FindOffset(const JointColumns& c, const JointQuestion& q,
                                 const JointFit& fit) {
  const JointFit free = WithoutBounds(c, fit);
  const Index up = fit.At(Role::law).begin + 1, down = up + 1;
  const double mean = (free.Value(up) + free.Value(down)) / 2;
  if (!(mean > 0)) return std::nullopt;
  const double difference = free.Value(up) - free.Value(down);
  const MatrixXd& errors = free.uncertainty.covariance;
  const double deviation = std::sqrt(errors(up, up) + errors(down, down) - 2 * errors(up, down));
  const double least = kBeyondFlanks * kFlanks * mean + ReachOf(free, q) * deviation;
  if (!(std::abs(difference) > least)) return std::nullopt;
  return kFlanks * mean;
}

/// Squares on the last part of the log by a fit to the first part, which starts from the given fit.
double HeldOutSquares(const JointFit& fit, const JointColumns& c) {
  const auto cut = SplitOf({c.samples.keep, {}}, kUnseen);
  if (!cut) return kInfinity;
  ModelSamples first = c.samples;
  first.keep = cut->first.keep;
  return Kept(Solve(fit.model, first, fit.solved.x).residual, cut->rest).squaredNorm();
}

/// Whether a further mechanism predicts unseen samples no worse than the fit without it. Why: a mechanism that a log shows by
/// chance, or in place of something else that the model lacks, does not continue in the rest of the log.
bool Predicts(const JointFit& further, const JointFit& without, const JointColumns& c) {
  return HeldOutSquares(further, c) <= HeldOutSquares(without, c);
}

/// Whether viscous friction is below 0 beyond chance: friction falls with speed.
bool Falls(const JointColumns& c, const JointQuestion& q, const JointFit& cold) {
  JointFit judged = cold;
  FindBeyond(c, q, judged);
  return std::ranges::find(judged.beyond, kViscousRow.name) != judged.beyond.end();
}

/// The fit with friction that rises at low speed, where the log shows it; of a friction that falls with speed, at the share of the top speed that leaves
/// least.
std::optional<JointFit> FindSlow(const JointColumns& c, const GainGuess& guess,
                                 const JointQuestion& q, Further further, const JointFit& cold) {
  if (!q.slows) return std::nullopt;
  const bool falls = Falls(c, q, cold);
  const Index shares = falls ? std::ssize(kSlowShares) : 1;
  std::optional<JointFit> best;
  for (Index share = 0; share < shares; ++share) {
    further.slow = share;
    JointFit slow = FitSlow(c, guess, q, further, cold);
    if (best && !(slow.solved.noise.variance < best->solved.noise.variance)) continue;
    best = std::move(slow);
  }
  const Index rise = best->At(Role::law).end() - 1;
  const double level_of_one = q.error_level / static_cast<double>(shares) / q.joints;
  const double reach = StudentQuantile(best->uncertainty.degrees_of_freedom, 1 - level_of_one);
  const bool is_shown =
      best->Value(rise) > reach * best->Deviation(rise) && Predicts(*best, cold, c);
  return is_shown ? best : std::nullopt;
}

/// Adds what the model may lack. warm: the fit with heat as well, where the log shows one; with fields it stays where it is likelier
/// than a friction that drifts
JointFit Concluded(const JointColumns& c, const JointQuestion& q, JointFit cold,
                   std::optional<JointFit> warm) {
  if (warm) AddFields(c, q.fields, *warm);
  const bool rivals = !warm || q.fields.Has(FieldKind::time_friction);
  if (rivals) AddFields(c, q.fields, cold);
  const bool compared = warm && warm->fields && cold.fields;
  const bool warms = warm && (!compared || warm->fields->fit.figures.fields->cost <
                                               cold.fields->fit.figures.fields->cost);
  JointFit fit = warms ? *std::move(warm) : std::move(cold);
  fit.description_error = DescriptionErrorOf(fit, q);
  FindBeyond(c, q, fit);
  return fit;
}

}  // namespace

GivenPlaces JointFit::Given() const {
  const Index scale = At(Role::scale).begin;
  const double value = model.table[static_cast<std::size_t>(scale)].value;
  return {scale, std::copysign(1.0, value), At(Role::direction)};
}

void JointColumns::AddDirections(const MatrixXd& of_rigid, const MatrixXd& of_carried) {
  const auto append = [](const MatrixXd& columns, MatrixXd& directions) {
    directions.conservativeResize(Eigen::NoChange, directions.cols() + columns.cols());
    directions.rightCols(columns.cols()) = columns;
  };
  append(of_rigid, rigid.directions);
  append(of_carried, carried.directions);
}

bool IsTorque(const JointColumns& c) { return c.torque_unit == kTorqueUnit.For(c.kind); }

GainPrior PriorOfGain(const JointColumns& c, const GainGuess& guess, double middle_gain) {
  if (!IsTorque(c)) return {middle_gain, 1};
  const auto off = [](double gain, double factor) {
    return std::abs(std::log(gain)) > std::log(factor);
  };
  const double middle = off(middle_gain, kOtherUnit) ? middle_gain : 1;
  const double own = std::abs(guess.value) / middle;
  if (guess.IsSure() && off(own, kAlikeGains)) return {middle, 1};
  return {middle, std::log(kAlikeGains) / kNormal95};
}

GainGuess GuessGain(const JointColumns& c, Description description) {
  // least squares with the description as it is, or with its errors by their prior
  const Selection used{c.samples.keep, {}};
  const Index r = description == Description::as_prior ? c.rigid.directions.cols() : 0;
  MatrixXd columns(c.velocity.size(), 5 + r);
  columns << c.rigid.force, c.velocity, c.forwards, -c.backwards, c.acceleration,
      c.rigid.directions.leftCols(r);
  columns = Kept(columns, used);
  const VectorXd y = Kept(c.samples.torque, used);
  MatrixXd h = GramOf(columns);
  VectorXd x = SolveScaled(h, columns.transpose() * y);
  NoiseScale noise = NoiseScaleOf(y - columns * x);
  if (r > 0) {
    h.diagonal().tail(r).array() += noise.scale();
    x = SolveScaled(h, columns.transpose() * y);
    noise = NoiseScaleOf(y - columns * x);
  }
  const MatrixXd covariance = InverseScaled(h) * noise.scale();
  // friction at the mean speed, the mean of both directions
  VectorXd mean = VectorXd::Zero(5 + r);
  mean[1] = columns.col(1).cwiseAbs().mean();
  mean[2] = mean[3] = .5;
  const auto over_deviation = [&](const VectorXd& weights) {
    const double deviation = std::sqrt(weights.dot(covariance * weights));
    return deviation > 0 ? weights.dot(x) / deviation : 0;
  };
  return {x[0], std::abs(over_deviation(VectorXd::Unit(5 + r, 0))), over_deviation(mean)};
}

JointFit FitJoint(const JointColumns& c, const GainGuess& guess, const JointQuestion& q) {
  Further further;
  if (c.ripple.cols() > 0) further.ripple = LevelOf(c, guess, q);
  JointFit fit = FitCold(c, guess, q, further);
  further.flanks = FindOffset(c, q, fit);
  if (further.flanks) fit = FitCold(c, guess, q, further);
  if (std::optional<JointFit> slow = FindSlow(c, guess, q, further, fit)) fit = *std::move(slow);
  if (q.warms) {
    const HeatGuess heat = FindHeat(c, fit, q);
    fit.warming = heat.deviations;
    if (heat.warms) {
      JointFit warm = fit;
      AddHeat(c, heat, warm);
      SolveOn(c, warm);
      AddErrors(c, warm);
      // the fit has to agree, with a time constant within those that were tried
      const Index gain = warm.At(Role::gain).begin;
      const bool is_told = warm.Value(gain) < -heat.limit * warm.Deviation(gain) &&
                           warm.Value(gain + 1) >= std::log(heat.shortest);
      if (is_told && Predicts(warm, fit, c)) return Concluded(c, q, fit, std::move(warm));
    }
  }
  return Concluded(c, q, std::move(fit), std::nullopt);
}

}  // namespace warmjoint

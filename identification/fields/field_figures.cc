#include "identification/fields/field_figures.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "identification/fields/field_rows.h"
#include "identification/fit/fit_data.h"
#include "identification/forward/log_trajectory.h"
#include "identification/linear/linear_laws.h"
#include "identification/model/normal_equations.h"
#include "identification/typical_speeds.h"
#include "identification/uncertainty/tails.h"
#include "models/foundation/robust_noise.h"
#include "models/friction/evaluate_map.h"
#include "models/friction/sign.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// of -2 log p; why: of an amplitude that is 0, half a chi-squared of one degree of freedom, once in a hundred
constexpr double kBeyondChance = 5.41;
constexpr double kShownConstant =
    2.58;  // deviations; why: chance reaches them in one log of a hundred
constexpr double kSlow = 0.1, kFast = 0.9;  // quantiles of the speed between which a line is laid
constexpr double kOneSpeed = 1.3;  // ratio of both; why: a line between nearer ones is noise
constexpr int kSpeedCentres = 24;  // of each direction
constexpr double kNarrow =
    0.5;  // of the centres' distance; why: narrower kernels make steps between centres

/// Derivatives by the values of the table's rows. function: [p + m] by the coordinates of the estimated ones; returns [P]
VectorXd ByRows(const VectorXd& function, const Fit& fit) {
  VectorXd by_rows = VectorXd::Zero(std::ssize(fit.parameters));
  Index column = 0;
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const Unknown& row = fit.parameters[i];
    if (!row.estimated) continue;
    by_rows[static_cast<Index>(i)] = function[column++] / row.ValueByCoordinate(row.value);
  }
  return by_rows;
}

/// Weights of normalised kernels with which a map has these values at its centres. values: [m]
std::vector<double> WeightsFor(const GaussianAxis& axis, const VectorXd& values) {
  const auto m = static_cast<Index>(axis.size());
  MatrixXd kernels(m, m);
  VectorXd row(m);
  for (Index i = 0; i < m; ++i) {
    AxisKernels(axis, KernelKind::normalised, axis.centres[static_cast<size_t>(i)], row.data());
    kernels.row(i) = row;
  }
  const VectorXd weights = kernels.partialPivLu().solve(values);
  return {weights.begin(), weights.end()};
}

GaussianAxis AxisOver(const Knots& knots) {
  const auto count = static_cast<int>(knots.size());
  GaussianAxis axis = knots.period ? CircleAxis(*knots.period, count)
                                   : EvenAxis(knots.at[0], knots.at[knots.size() - 1], count);
  axis.width *= kNarrow;
  return axis;
}

/// Whether a field is of its log alone: it changes with what friction files do not know.
bool IsOverTime(FieldKind kind) {
  return kind == FieldKind::temperature_friction || kind == FieldKind::time_friction ||
         kind == FieldKind::time_torque;
}

}  // namespace

VectorXd FieldsAlong(const SolvedFields& solved, Index p, const LogSamples& m) {
  const Index others = solved.evidence.flat() - p;
  VectorXd along = VectorXd::Constant(m.size(), solved.posterior.mean.segment(p, others).sum());
  const FieldMotion motion = MotionOf(m);
  for (size_t k = 0; k < solved.blocks.size(); ++k) {
    along += solved.blocks[k].ColumnsAt(motion) * solved.ValuesOf(k);
  }
  return along;
}

VectorXd FrictionOverTime(const SolvedFields& solved) {
  const FieldRows& rows = solved.rows;
  for (size_t k = 0; k < solved.blocks.size(); ++k) {
    const FieldBlock& block = solved.blocks[k];
    if (block.kind != FieldKind::time_friction) continue;
    return block.UnsignedAt(rows) * solved.ValuesOf(k);
  }
  return {};
}

VectorXd DriftAlong(const SolvedFields& solved, const LogSamples& m) {
  VectorXd along = VectorXd::Zero(m.size());
  const FieldMotion motion = MotionOf(m);
  for (size_t k = 0; k < solved.blocks.size(); ++k) {
    const FieldBlock& block = solved.blocks[k];
    if (!IsOverTime(block.kind)) continue;
    along += block.ColumnsAt(motion) * solved.ValuesOf(k);
    if (block.kind != FieldKind::time_friction) continue;
    const double mean = block.mean.dot(solved.ValuesOf(k));
    along -= mean * m.velocity.unaryExpr([](double v) -> double { return Sign(v); });
  }
  return along;
}

FieldFigures::FieldFigures(const SolvedFields& solved, const Fit& fit, const LogSamples& m)
    : solved_(solved), fit_(fit), m_(m) {
  const double cost = solved.evidence.Cost(solved.best);
  for (size_t k = 0; k < solved.blocks.size(); ++k) {
    FieldHyperparameters without = solved.best;
    without.amplitudes[k] = 0;
    if (solved.evidence.Cost(without) - cost > kBeyondChance)
      held_.push_back(solved.blocks[k].kind);
  }

  means_ = MeansOfFields();
  up_to_ = CovariancesUpTo();

  // the mean of what depends on place and time belongs to the level, and a line through the curve over the speed to both
  const Index p = UnknownsOf(fit).size();
  report_ = MatrixXd::Identity(p, solved.evidence.size());
  VectorXd speeds = solved.rows.velocity.cwiseAbs();
  const double slow = QuantileInPlace(speeds, kSlow), fast = QuantileInPlace(speeds, kFast);
  const auto has = [&](LawPart part) {
    return std::ranges::any_of(fit.parameters,
                               [=](const Unknown& row) { return row.part == part; });
  };
  VectorXd slope = VectorXd::Zero(means_.size()), level = means_;
  const bool warms = fit.model.friction.thermal.has_value();  // by the loss of its best line
  if (!warms && has(LawPart::slope) && has(LawPart::level) && fast > kOneSpeed * slow) {
    const VectorXd at_slow = OfFields(slow);
    slope = (OfFields(fast) - at_slow) / (fast - slow);
    level = at_slow - slow * slope;
  }
  Index column = 0;
  for (const Unknown& row : fit.parameters) {
    if (!row.estimated) continue;
    if (row.role == Role::law && row.part == LawPart::slope)
      report_.row(column) += slope.transpose();
    if (row.role == Role::law && row.part == LawPart::level)
      report_.row(column) += level.transpose();
    ++column;
  }
  if (!warms && fast > kOneSpeed * slow) HoldFlat(slow, fast);
}

void FieldFigures::HoldFlat(double slow, double fast) {
  Index slope = -1, column = 0;
  std::vector<Index> levels;
  for (const Unknown& row : fit_.parameters) {
    if (!row.estimated) continue;
    const bool is_law = row.role == Role::law;
    if (is_law && row.part == LawPart::slope && row.lower == 0) slope = column;
    if (is_law && row.part == LawPart::level) levels.push_back(column);
    ++column;
  }
  if (slope < 0 || levels.empty()) return;
  const VectorXd of_slope = report_.row(slope);
  if (of_slope.dot(solved_.posterior.mean) > -kNormal95 * Deviation(of_slope)) return;
  for (const double speed : {slow, fast}) {
    for (const double way : {-1.0, 1.0}) {
      const VectorXd friction = AtVelocity(way * speed, 0);
      if (friction.dot(solved_.posterior.mean) < kNormal95 * Deviation(friction)) return;
    }
  }
  falls_ = true;
  const double median = MedianOf(solved_.rows.velocity.cwiseAbs());
  report_.row(slope).setZero();
  for (const Index level : levels) {
    report_.row(level) = OfFields(median).transpose();
    report_(level, level) += 1;
    report_(level, slope) += median;
  }
}

VectorXd FieldFigures::MeansOfFields() const {
  VectorXd function = VectorXd::Zero(solved_.evidence.size());
  const int way = OnlyWay(solved_.rows.velocity);
  for (size_t k = 0; k < solved_.blocks.size(); ++k) {
    const FieldBlock& block = solved_.blocks[k];
    if (block.kind == FieldKind::speed_friction) continue;
    // a torque counts where the log has one direction alone, in which it cannot be told from friction
    const double sign = IsFriction(block.kind) ? 1 : way;
    function.segment(solved_.evidence.Begin(k), block.size()) = sign * block.mean;
  }
  return function;
}

VectorXd FieldFigures::OfFields(double speed) const {
  VectorXd function = means_;
  const VectorXd at = VectorXd::Constant(1, speed);
  const FieldMotion there{at, at, at};
  for (size_t k = 0; k < solved_.blocks.size(); ++k) {
    const FieldBlock& block = solved_.blocks[k];
    if (block.kind != FieldKind::speed_friction) continue;
    function.segment(solved_.evidence.Begin(k), block.size()) =
        block.UnsignedAt(there).transpose() * VectorXd::Ones(1);
  }
  return function;
}

VectorXd FieldFigures::AtVelocity(double velocity, double load) const {
  VectorXd function = OfFields(std::abs(velocity));
  const Law& law = *FindLaw(fit_.model.friction.law);
  const MatrixXd of_law = Sign(velocity) * LawColumns(law, VectorXd::Constant(1, velocity));
  Index column = 0, of = 0;
  for (const Unknown& row : fit_.parameters) {
    if (!row.estimated) continue;
    if (row.role == Role::law) function[column] = of_law(0, of++);
    if (row.role == Role::load) function[column] = load;
    ++column;
  }
  return function;
}

double FieldFigures::Deviation(const VectorXd& function) const {
  return std::sqrt(std::max(function.dot(solved_.posterior.covariance * function), 0.0));
}

std::vector<ErrorUpTo<MatrixXd>> FieldFigures::CovariancesUpTo() const {
  const std::pair<ErrorBy, std::vector<FieldKind>> later[] = {
      {ErrorBy::place, {FieldKind::place_torque, FieldKind::place_friction}},
      {ErrorBy::speed, {FieldKind::speed_friction}},
      {ErrorBy::time,
       {FieldKind::temperature_friction, FieldKind::time_friction, FieldKind::time_torque}}};
  // from the whole on, one after the other becomes known
  std::vector<ErrorUpTo<MatrixXd>> all{
      {ErrorBy::strength, solved_.posterior.covariance},
      {ErrorBy::time, solved_.evidence.At(solved_.best).covariance}};
  const auto know = [&](ErrorBy by, const std::vector<Index>& known) {
    if (known.empty()) return;
    const MatrixXd& given = all.back().value;
    const MatrixXd of = given(known, Eigen::all);
    all.push_back({by, given - of.transpose() * InverseScaled(of(Eigen::all, known)) * of});
  };
  for (size_t i = std::size(later); i-- > 0;) {
    std::vector<Index> known;
    for (size_t k = 0; k < solved_.blocks.size(); ++k) {
      if (solved_.best.amplitudes[k] == 0 ||
          std::ranges::find(later[i].second, solved_.blocks[k].kind) == later[i].second.end())
        continue;
      for (Index j = 0; j < solved_.blocks[k].size(); ++j) {
        known.push_back(solved_.evidence.Begin(k) + j);
      }
    }
    know(i > 0 ? later[i - 1].first : ErrorBy::description, known);
  }

  // a description's errors are rows without a name
  std::vector<Index> described;
  Index column = 0;
  for (const Unknown& row : fit_.parameters) {
    if (!row.estimated) continue;
    if (row.name.empty() && row.prior) described.push_back(column);
    ++column;
  }
  know(ErrorBy::noise, described);
  if (described.empty()) all.back().by = ErrorBy::noise;
  std::ranges::reverse(all);
  return all;
}

bool FieldFigures::Holds(FieldKind kind) const {
  return std::ranges::find(held_, kind) != held_.end();
}

VectorXd FieldFigures::Reported() const { return report_ * solved_.posterior.mean; }

Uncertainty FieldFigures::UncertaintyOf(const VectorXd& residual, double effective) const {
  Uncertainty uncertainty;
  uncertainty.covariance = report_ * solved_.posterior.covariance * report_.transpose();
  for (const auto& [by, covariance] : up_to_) {
    uncertainty.up_to.push_back({by, report_ * covariance * report_.transpose()});
  }
  uncertainty.noise = FitNoise(residual, fit_.rows.used);
  const double correlation = solved_.evidence.LeftCorrelation(solved_.best, solved_.posterior.mean);
  uncertainty.degrees_of_freedom =
      std::max(1.0, static_cast<double>(solved_.rows.size()) / correlation - effective);
  return uncertainty;
}

void FieldFigures::AddMap(FrictionMap map, const MatrixXd& functions, double reach,
                          Fit& fit) const {
  const auto law = static_cast<Index>(FindLaw(fit.model.friction.law)->parameters.size());
  MapBand& band = fit.figures.bands.emplace_back();
  band.quantities.emplace_back(NameOf(map.axes[0].quantity));
  for (Index g = 0; g < functions.rows(); ++g) {
    const VectorXd function = functions.row(g);
    const double value = function.dot(solved_.posterior.mean), deviation = Deviation(function);
    band.points.push_back({map.axes[0].kernels.centres[static_cast<size_t>(g)]});
    band.value.push_back(value);
    band.std.push_back(deviation);
    band.interval95.push_back({value - reach * deviation, value + reach * deviation});
  }
  fit.figures.bands_by_law.push_back(functions.leftCols(law));
  fit.model.friction.maps.push_back(std::move(map));
}

void FieldFigures::AddTo(double degrees_of_freedom, Fit& fit) const {
  const double reach = StudentQuantile(degrees_of_freedom, kIntervalLevel);
  AddFriction(reach, fit);
  AddPlaces(reach, fit);
  if (Holds(FieldKind::speed_friction) || falls_) AddCurve(reach, fit);
}

std::optional<FieldFigures::WarmMoment> FieldFigures::Warmest(const Fit& fit) const {
  if (!fit.model.friction.thermal) return std::nullopt;
  const VectorXd energy = PredictFriction(fit.model.friction, m_, fit.Start()).energy;
  Index warmest = -1;
  for (Index i = 0; i < m_.size(); ++i) {
    if (!fit.rows.used.keep[i]) continue;
    if (warmest < 0 || std::abs(energy[i]) > std::abs(energy[warmest])) warmest = i;
  }

  // F = Fn + sign(v) E: what the heat adds to the derivatives of Fn
  const VectorXd along = fit_.rows.jacobian().row(warmest);
  MatrixXd cold = LawColumns(*FindLaw(fit.model.friction.law), m_.velocity.segment(warmest, 1));
  const PartFit grows = fit.RowOf(Role::load) ? PartFit::estimated : PartFit::none;
  cold = WithLoad(std::move(cold), grows, m_.velocity.segment(warmest, 1),
                  m_.load ? std::optional<VectorXd>(m_.load->segment(warmest, 1)) : std::nullopt);
  WarmMoment moment{energy[warmest], VectorXd::Zero(solved_.evidence.size())};
  Index column = 0, of = 0;
  for (const Unknown& row : fit_.parameters) {
    if (!row.estimated) continue;
    const bool of_heat = IsHeat(row.role) || row.role == Role::start || row.role == Role::jump;
    const double by_law = IsNominal(row.role) ? cold(0, of++) : 0;
    if (of_heat || IsNominal(row.role)) {
      moment.function[column] = Sign(m_.velocity[warmest]) * (along[column] - by_law);
    }
    ++column;
  }
  return moment;
}

void FieldFigures::AddFriction(double reach, Fit& fit) const {
  const VectorXd kept = Kept(m_.velocity, fit.rows.used);
  const std::vector<SpeedGroup> groups = TypicalSpeeds(kept);
  const bool loads = fit.RowOf(Role::load).has_value();
  const std::vector<double> carried =
      MeanLoads(groups, loads ? Kept(*m_.load, fit.rows.used) : VectorXd());
  const auto add = [&](double velocity, const VectorXd& function, std::optional<double> energy,
                       const VectorXd& by_heat) {
    // the heat is no linear function of the unknowns: its value is its own
    const double value = function.dot(solved_.posterior.mean) + energy.value_or(0);
    const double deviation = Deviation(function + by_heat);
    fit.figures.friction_at_speeds.push_back(
        {.speed = velocity,
         .value = value,
         .std = deviation,
         .interval95 = {value - reach * deviation, value + reach * deviation},
         .energy = energy});
    fit.figures.fields->at_speeds_by_rows.push_back(ByRows(function + by_heat, fit));
    std::vector<ErrorUpTo<double>>& up_to = fit.figures.fields->at_speeds_up_to.emplace_back();
    for (const auto& [by, covariance] : up_to_) {
      const VectorXd all = function + by_heat;
      up_to.push_back({by, std::sqrt(std::max(all.dot(covariance * all), 0.0))});
    }
  };
  const auto warmest = Warmest(fit);
  const std::optional<double> cold = warmest ? std::optional(0.0) : std::nullopt;
  std::vector<VectorXd> functions;
  for (size_t i = 0; i < groups.size(); ++i) {
    functions.push_back(AtVelocity(groups[i].velocity, carried[i]));
    add(groups[i].velocity, functions.back(), cold, VectorXd::Zero(solved_.evidence.size()));
  }
  for (size_t i = 0; warmest && i < groups.size(); ++i) {
    add(groups[i].velocity, functions[i], warmest->energy, warmest->function);
  }
}

bool FieldFigures::HasConstant(size_t place_torque) const {
  const Index p = report_.rows(), others = solved_.evidence.flat() - p;
  if (others == 0) return false;
  // the constant, with the mean of the torque over the places
  const FieldBlock& block = solved_.blocks[place_torque];
  VectorXd function = VectorXd::Zero(solved_.evidence.size());
  function.segment(p, others).setOnes();
  function.segment(solved_.evidence.Begin(place_torque), block.size()) = block.mean;
  return std::abs(function.dot(solved_.posterior.mean)) > kShownConstant * Deviation(function);
}

void FieldFigures::AddPlaces(double reach, Fit& fit) const {
  // as bands, friction at the median speed, or the torque alone
  const double median = MedianOf(Kept(m_.velocity, fit.rows.used).cwiseAbs());
  for (size_t k = 0; k < solved_.blocks.size(); ++k) {
    const FieldBlock& block = solved_.blocks[k];
    const Index begin = solved_.evidence.Begin(k), p = report_.rows();
    const bool is_load = block.kind == FieldKind::place_torque;
    if (!is_load && block.kind != FieldKind::place_friction) continue;
    if (!Holds(block.kind) && !(is_load && HasConstant(k))) continue;
    MatrixXd functions = MatrixXd::Zero(block.size(), solved_.evidence.size());
    functions.middleCols(begin, block.size()).setIdentity();
    if (is_load) functions.middleCols(p, solved_.evidence.flat() - p).setOnes();
    VectorXd values = functions * solved_.posterior.mean;
    FrictionMap map{.axes = {{MapQuantity::position, AxisOver(block.knots)}},
                    .weights = {},
                    .factor = is_load ? MapFactor::one : MapFactor::direction};
    if (!is_load) {
      // the mean over the places is in the level
      VectorXd level = AtVelocity(median, 0);
      values.array() -= level.segment(begin, block.size()).dot(solved_.ValuesOf(k));
      level.segment(begin, block.size()).setZero();
      functions.rowwise() += level.transpose();
    }
    map.weights = WeightsFor(map.axes[0].kernels, values);
    AddMap(std::move(map), functions, reach, fit);
  }
}

void FieldFigures::AddCurve(double reach, Fit& fit) const {
  const VectorXd speeds = Kept(m_.velocity, fit.rows.used).cwiseAbs();
  FrictionMap map{.axes = {{MapQuantity::velocity,
                            SpeedAxis(speeds.minCoeff(), speeds.maxCoeff(), kSpeedCentres)}},
                  .weights = {}};
  GaussianAxis& axis = map.axes[0].kernels;
  axis.width *= kNarrow;
  MatrixXd functions(std::ssize(axis.centres), solved_.evidence.size());
  VectorXd values(functions.rows());
  const std::vector<double> law = LawValues(fit.model.friction);
  for (Index g = 0; g < functions.rows(); ++g) {
    const double v = axis.centres[static_cast<size_t>(g)];
    functions.row(g) = Sign(v) * AtVelocity(v, 0);
    // beyond the law as it is reported
    values[g] = functions.row(g).dot(solved_.posterior.mean) -
                FindLaw(fit.model.friction.law)->force(v, law.data());
  }
  map.weights = WeightsFor(axis, values);
  AddMap(std::move(map), functions, reach, fit);
}

std::vector<FieldShare> FieldFigures::Shares(double friction) const {
  std::vector<FieldShare> shares;
  for (size_t k = 0; k < solved_.blocks.size(); ++k) {
    const FieldBlock& block = solved_.blocks[k];
    if (!Holds(block.kind)) continue;
    const VectorXd along = block.columns * solved_.ValuesOf(k);
    const double rms = std::sqrt(along.squaredNorm() / static_cast<double>(along.size()));
    shares.push_back({block.kind, rms / friction});
  }
  return shares;
}

}  // namespace warmjoint

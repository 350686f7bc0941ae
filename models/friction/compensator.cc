#include "models/friction/compensator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "models/friction/laws.h"

namespace warmjoint {
namespace {

static_assert(WJ_MOST_AXES == kMostMapAxes && WJ_MOST_CENTRES == kMostMapCentres);

/// A speed at which no level rises any more, rad/s or m/s.
constexpr double kFast = 1e300;

/// A law by its slope, its level to each side and how that rises at rest: all that slides.
void TakeLaw(const Friction& friction, wj_friction& numbers) {
  const std::vector<double> values = LawValues(friction);
  ForLawNamed(AllLaws{}, friction.law, [&]<typename L>() {
    numbers.coulomb_positive = L::Level(1, kFast, values.data());
    numbers.coulomb_negative = L::Level(-1, kFast, values.data());
    numbers.static_rise = L::Level(1, 0.0, values.data()) - numbers.coulomb_positive;
  });
  const auto value = [&](std::string_view name) {
    const auto found = friction.parameters.find(std::string(name));
    return found == friction.parameters.end() ? 0 : found->second;
  };
  numbers.viscous = value(kViscousRow.name);
  numbers.stribeck_velocity = value(kStribeckVelocityRow.name);
  numbers.stribeck_exponent = value(kStribeckExponentRow.name);
}

void TakeHeat(const Friction& friction, wj_friction& numbers) {
  if (friction.thermal) {
    numbers.thermal_gain = friction.thermal->gain;
    numbers.thermal_time_constant = friction.thermal->time_constant;
  }
  if (friction.second_thermal) {
    numbers.second_thermal_gain = friction.second_thermal->gain;
    numbers.second_thermal_time_constant = friction.second_thermal->time_constant;
  }
  numbers.level_per_temperature = friction.level_per_temperature;
  numbers.viscous_per_energy = friction.viscous_per_energy;
}

wj_axis AxisOf(const MapAxis& axis) {
  const GaussianAxis& kernels = axis.kernels;
  // both lists of quantities have the same order
  return {static_cast<wj_quantity>(axis.quantity),
          kernels.sides == Sides::apart ? WJ_APART : WJ_TOGETHER,
          static_cast<int>(kernels.size()),
          kernels.centres.data(),
          kernels.width,
          kernels.period.value_or(0)};
}

wj_map MapOf(const FrictionMap& map) {
  wj_map found{};
  found.axis_count = static_cast<int>(map.axes.size());
  for (size_t i = 0; i < map.axes.size(); ++i) found.axes[i] = AxisOf(map.axes[i]);
  found.kernels = map.kernels == KernelKind::plain ? WJ_PLAIN : WJ_NORMALISED;
  found.factor = map.factor == MapFactor::velocity    ? WJ_BY_VELOCITY
                 : map.factor == MapFactor::direction ? WJ_BY_DIRECTION
                                                      : WJ_BY_ONE;
  found.weights = map.weights.data();
  return found;
}

static_assert(static_cast<int>(MapQuantity::position) == WJ_POSITION &&
              static_cast<int>(MapQuantity::motor_position) == WJ_MOTOR_POSITION &&
              static_cast<int>(MapQuantity::velocity) == WJ_VELOCITY &&
              static_cast<int>(MapQuantity::energy) == WJ_ENERGY &&
              static_cast<int>(MapQuantity::load) == WJ_LOAD);

}  // namespace

/// What the numbers of maps point into.
struct CompensatorNumbers::Arrays {
  std::vector<FrictionMap> maps;
  std::vector<wj_map> numbers;
};

CompensatorNumbers::CompensatorNumbers(const Friction& friction, const FrictionDoubt& doubt) {
  TakeLaw(friction, numbers_);
  TakeHeat(friction, numbers_);
  numbers_.load_gain = friction.load_gain;
  numbers_.gear = friction.gear;
  numbers_.level_std = doubt.level_std;
  numbers_.heat_std = doubt.heat_std;
  numbers_.noise = doubt.noise;
  numbers_.noise_time = doubt.noise_time;

  // maps point into what all copies share
  auto arrays = std::make_shared<Arrays>(Arrays{friction.maps, {}});
  for (const FrictionMap& map : arrays->maps) arrays->numbers.push_back(MapOf(map));
  numbers_.map_count = static_cast<int>(arrays->numbers.size());
  numbers_.maps = arrays->numbers.data();
  arrays_ = std::move(arrays);
}

Compensator::Compensator(const Friction& friction, const FrictionDoubt& doubt,
                         const CompensatorSettings& settings)
    : numbers_(friction, doubt) {
  wj_begin(&joint_, &numbers_.numbers());
  wj_settings& own = joint_.settings;
  own.share = settings.share;
  own.dead_band = settings.dead_band;
  if (settings.most_speed > 0) own.most_speed = settings.most_speed;
  if (settings.longest_gap > 0) own.longest_gap = settings.longest_gap;
  if (settings.contact_time > 0) own.contact_time = settings.contact_time;
  if (settings.deviations > 0) own.deviations = settings.deviations;
  own.heat = settings.heat == HeatSource::torque ? WJ_HEAT_BY_TORQUE : WJ_HEAT_BY_MODEL;
  own.correct = settings.correct == LevelCorrection::by_torque ? WJ_CORRECTED : WJ_OPEN_LOOP;
}

std::array<double, Compensator::kMemory> Compensator::Memory() const {
  const wj_joint& j = joint_;
  return {j.state.energy,   j.state.second_energy, j.state.correction, j.state.variance,
          j.found.friction, j.found.residual,      j.found.energy,     j.found.std,
          j.found.loss,     1.0 * j.found.contact, j.lost_digits[0],   j.lost_digits[1],
          j.step,           j.cooling[0],          j.cooling[1],       j.walk,
          j.lost_time,      j.mean_residual,       j.last_velocity,    j.last_torque,
          j.at.ambient_rise};
}

void Compensator::Remember(const std::array<double, kMemory>& m) {
  wj_joint& j = joint_;
  j.state = {m[0], m[1], m[2], m[3]};
  j.found = {m[4], m[5], m[6], m[7], m[8], m[9] != 0};
  j.lost_digits[0] = m[10];
  j.lost_digits[1] = m[11];
  j.step = m[12];
  j.cooling[0] = m[13];
  j.cooling[1] = m[14];
  j.walk = m[15];
  j.lost_time = m[16];
  j.mean_residual = m[17];
  j.last_velocity = m[18];
  j.last_torque = m[19];
  j.at.ambient_rise = m[20];
}

namespace {

double At(const Eigen::VectorXd& column, Eigen::Index i, double otherwise) {
  return column.size() > 0 ? column[i] : otherwise;
}

/// The median time between two samples, s; 0 of fewer than two.
double MedianStep(const Eigen::VectorXd& time) {
  std::vector<double> steps;
  for (Eigen::Index i = 1; i < time.size(); ++i) steps.push_back(time[i] - time[i - 1]);
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + std::ssize(steps) / 2;
  std::ranges::nth_element(steps, middle);
  return *middle;
}

}  // namespace

Compensated CompensateAlong(Compensator& compensator, const JointTrajectory& motion,
                            const Eigen::VectorXd& reference) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Index n = motion.time.size();
  Compensated all;
  for (Eigen::VectorXd* column : {&all.compensation, &all.friction, &all.residual, &all.energy,
                                  &all.std, &all.loss, &all.contact}) {
    column->resize(n);
  }
  wj_joint& joint = compensator.joint();
  // why: two samples may be lost before the joint counts as at rest
  const double gap = 3 * MedianStep(motion.time);
  joint.settings.longest_gap = std::max(joint.settings.longest_gap, gap);

  auto start = motion.starts.begin();
  for (Eigen::Index i = 0; i < n; ++i) {
    double dt = i > 0 ? motion.time[i] - motion.time[i - 1] : 0;
    if (start != motion.starts.end() && *start == i) {
      joint.state.energy = joint.state.second_energy = dt = 0;
      ++start;
    }
    // surroundings are those of the time since the last sample
    if (i > 0) joint.at.ambient_rise = At(motion.ambient_rise, i - 1, 0);
    joint.at.position = At(motion.position, i, 0);
    joint.at.motor_position = At(motion.motor_position, i, none);
    joint.at.load = At(motion.load, i, 0);
    joint.at.reference = At(reference, i, none);
    all.compensation[i] = wj_step(&joint, motion.velocity[i], At(motion.torque, i, none), dt);
    const wj_found& found = joint.found;
    all.friction[i] = found.friction;
    all.residual[i] = found.residual;
    all.energy[i] = found.energy;
    all.std[i] = found.std;
    all.loss[i] = found.loss;
    all.contact[i] = found.contact;
  }
  return all;
}

}  // namespace warmjoint

#include "identification/model/heat_loop.h"

#include <algorithm>
#include <array>
#include <type_traits>

#include "identification/forward/holds.h"
#include "models/foundation/four.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Derivatives of E by the friction's unknowns: plain numbers where their number D is known, so that they stay in registers.
template <int D>
class FrictionSlopes {
 public:
  explicit FrictionSlopes(VectorXd& all) : all_(all) { std::copy_n(all.data(), D, own_.begin()); }
  ~FrictionSlopes() { std::ranges::copy(own_, all_.data()); }
  FrictionSlopes(const FrictionSlopes&) = delete;
  FrictionSlopes& operator=(const FrictionSlopes&) = delete;
  double& operator[](Index i) { return own_[static_cast<std::size_t>(i)]; }

 private:
  VectorXd& all_;
  std::array<double, static_cast<std::size_t>(D)> own_;
};

template <>
class FrictionSlopes<Eigen::Dynamic> {
 public:
  explicit FrictionSlopes(VectorXd& all) : all_(all.data()) {}
  double& operator[](Index i) { return all_[i]; }

 private:
  double* all_;
};

/// HeatLoop::Add for D unknowns of friction.
template <int D>
void AddAlong(const HeatLoop& heat, const VectorXd& x, const std::vector<IntervalHold>& holds,
              const ModelRows& losses, HeatState& state, ModelRows& rows) {
  const ClosedLoop& loop = *heat.loop;
  const std::vector<int>& which = loop.intervals().which;
  const double *speed = loop.speed().data(), *sign = loop.direction().data();
  const Index count = D == Eigen::Dynamic ? heat.friction : D, stride = rows.derivatives.cols();
  const Index gain = heat.parameters.begin, tau = gain + 1, start = heat.start.begin;
  const double k = x[gain];
  const bool has_start = heat.start.size > 0, are_own = &losses != &rows;

  // locals, which may stay in registers
  double energy = state.energy, by_gain = state.slopes[gain], by_tau = state.slopes[tau];
  double by_start = has_start ? state.slopes[start] : 0;
  double* by_jumps = state.slopes.data() + heat.jumps.begin;
  FrictionSlopes<D> by_friction(state.slopes);
  auto jump = std::ranges::lower_bound(heat.jump_samples, rows.at.first);
  Index jumped = jump - heat.jump_samples.begin();

  for (Index i = 0; i < rows.at.count; ++i) {
    const Index n = rows.at.first + i;
    if (jump != heat.jump_samples.end() && *jump == n) {
      energy += x[heat.jumps.begin + jumped];
      by_jumps[jumped++] = 1;
      ++jump;
    }
    double* row = rows.derivatives.data() + i * stride;
    const double* of_loss = losses.derivatives.data() + i * stride;
    const double level = sign[n] * losses.force[i], shown = heat.direction[n];
    const IntervalHold& hold = holds[static_cast<std::size_t>(which[static_cast<std::size_t>(n)])];
    const auto [feedback, lambda] = FedBack(hold, speed[n]);
    const double fed = feedback * sign[n], loss = speed[n] * (level + energy);

    // what the heat adds at this sample, and its derivatives at the next one
    const auto add = [&](const double* levels) {
      for (Index p = 0; p < count; ++p) {
        const double fed_back = fed * levels[p];
        row[p] += shown * by_friction[p];
        by_friction[p] = lambda * by_friction[p] + fed_back;
      }
    };
    // by branches, so that the compiler knows which rows are the same
    are_own ? add(of_loss) : add(row);
    rows.energy[i] = energy;
    rows.force[i] += shown * energy;
    row[gain] += shown * by_gain;
    row[tau] += shown * by_tau;
    by_gain = ThermalStep(hold.cooling, lambda, by_gain, loss);
    by_tau = ThermalStep(hold.pole_slope, lambda, by_tau, energy - k * loss);
    if (has_start) {
      row[start] += shown * by_start;
      by_start *= lambda;
    }
    for (Index j = 0; j < jumped; ++j) {
      row[heat.jumps.begin + j] += shown * by_jumps[j];
      by_jumps[j] *= lambda;
    }
    energy = ThermalStep(feedback, lambda, energy, level);
  }
  state.energy = energy;
  state.slopes[gain] = by_gain;
  state.slopes[tau] = by_tau;
  if (has_start) state.slopes[start] = by_start;
}

/// The same where the number of unknowns is known at run time alone, for any processor.
WARMJOINT_FOR_EACH_PROCESSOR
void AddAlongMany(const HeatLoop& heat, const VectorXd& x, const std::vector<IntervalHold>& holds,
                  const ModelRows& losses, HeatState& state, ModelRows& rows) {
  AddAlong<Eigen::Dynamic>(heat, x, holds, losses, state, rows);
}

}  // namespace

HeatState HeatLoop::Begin(const VectorXd& x) const {
  HeatState state{0, VectorXd::Zero(x.size())};
  if (start.size > 0) {
    state.energy = x[start.begin];
    state.slopes[start.begin] = 1;
  }
  return state;
}

void HeatLoop::EnterLast(const VectorXd& x, HeatState& state) const {
  if (jump_samples.empty() || jump_samples.back() + 1 < loop->size()) return;
  const Index last = jumps.end() - 1;
  state.energy += x[last];
  state.slopes[last] = 1;
}

void HeatLoop::Add(const VectorXd& x, const std::vector<IntervalHold>& holds,
                   const ModelRows& losses, HeatState& state, ModelRows& rows) const {
  rows.energy.resize(rows.at.count);
  switch (friction) {
    case 1:
      return AddAlong<1>(*this, x, holds, losses, state, rows);
    case 2:
      return AddAlong<2>(*this, x, holds, losses, state, rows);
    case 3:
      return AddAlong<3>(*this, x, holds, losses, state, rows);
    default:
      return AddAlongMany(*this, x, holds, losses, state, rows);
  }
}

}  // namespace warmjoint

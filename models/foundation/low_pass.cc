#include "models/foundation/low_pass.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace warmjoint {
namespace {

/// Samples after which the slowest mode of the sections has fallen to rounding.
Eigen::Index SettlingLength(const std::vector<Biquad>& sections) {
  double slowest = 0;  // largest modulus of a pole
  for (const Biquad& section : sections) {
    // poles of z^2 + a1 z + a2: a complex pair, or the larger of two real ones
    const double square = section.a1 * section.a1 / 4 - section.a2;
    const double modulus =
        square < 0 ? std::sqrt(section.a2) : std::abs(section.a1) / 2 + std::sqrt(square);
    slowest = std::max(slowest, modulus);
  }
  return static_cast<Eigen::Index>(std::ceil(std::log(1e-12) / std::log(slowest)));
}

/// x with `pad` samples at each end that continue it by reflection at its end points.
Eigen::VectorXd Continued(const Eigen::VectorXd& x, Eigen::Index pad) {
  const Eigen::Index n = x.size();
  Eigen::VectorXd padded(n + 2 * pad);
  padded << 2 * x[0] - x.segment(1, pad).reverse().array(), x.array(),
      2 * x[n - 1] - x.segment(n - 1 - pad, pad).reverse().array();
  return padded;
}

Eigen::VectorXd FilterOnce(const std::vector<Biquad>& sections, const Eigen::VectorXd& x) {
  BiquadCascade filter(sections);
  // as if the first value had been there always
  filter.Settle(x[0]);
  Eigen::VectorXd y(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) y[i] = filter.Step(x[i]);
  return y;
}

}  // namespace

double ShareFollowed(double step, double time_constant) {
  return -std::expm1(-step / time_constant);
}

Eigen::VectorXd LowPass(const Eigen::VectorXd& time, const Eigen::VectorXd& x,
                        double time_constant) {
  Eigen::VectorXd filtered = x;
  for (Eigen::Index i = 1; i < x.size(); ++i) {
    // towards the sample before, held until this one
    const double share = ShareFollowed(time[i] - time[i - 1], time_constant);
    filtered[i] = filtered[i - 1] + share * (x[i - 1] - filtered[i - 1]);
  }
  return filtered;
}

std::vector<Biquad> ButterworthLowPass(int order, double cutoff, double rate) {
  assert(order > 0 && order % 2 == 0 && cutoff > 0 && cutoff < rate / 2);
  // the corner, as the bilinear transform bends the frequency
  const double corner = std::tan(std::numbers::pi * cutoff / rate);
  std::vector<Biquad> sections;
  for (int k = 0; k < order / 2; ++k) {
    // pole pair k of the prototype: s^2 + damping s + 1
    const double damping = 2 * std::sin(std::numbers::pi * (2 * k + 1) / (2 * order));
    const double scale = 1 / (1 + damping * corner + corner * corner);
    Biquad section;
    section.b0 = corner * corner * scale;
    section.b1 = 2 * section.b0;
    section.b2 = section.b0;
    section.a1 = 2 * (corner * corner - 1) * scale;
    section.a2 = (1 - damping * corner + corner * corner) * scale;
    sections.push_back(section);
  }
  return sections;
}

BiquadCascade::BiquadCascade(std::vector<Biquad> sections)
    : sections_(std::move(sections)), memory_(sections_.size(), Eigen::Vector2d::Zero()) {}

void BiquadCascade::Settle(double x) {
  // unit gain at 0 Hz: every section sees and gives x
  for (std::size_t k = 0; k < sections_.size(); ++k) {
    const Biquad& s = sections_[k];
    memory_[k] = {(1 - s.b0) * x, (s.b2 - s.a2) * x};
  }
}

double BiquadCascade::Step(double x) {
  for (std::size_t k = 0; k < sections_.size(); ++k) {
    const Biquad& s = sections_[k];
    Eigen::Vector2d& memory = memory_[k];
    // transposed direct form II
    const double y = s.b0 * x + memory[0];
    memory[0] = s.b1 * x - s.a1 * y + memory[1];
    memory[1] = s.b2 * x - s.a2 * y;
    x = y;
  }
  return x;
}

Eigen::VectorXd FilterZeroPhase(const std::vector<Biquad>& sections, const Eigen::VectorXd& x) {
  const Eigen::Index n = x.size();
  if (n < 2) return x;

  // a straight line passes unchanged, so only what is left beside it is filtered
  const Eigen::VectorXd line = Eigen::VectorXd::LinSpaced(n, x[0], x[n - 1]);
  const Eigen::Index pad = std::min(SettlingLength(sections), n - 1);
  // once in each direction, so that their delays cancel
  const Eigen::VectorXd forwards = FilterOnce(sections, Continued(x - line, pad));
  const Eigen::VectorXd backwards = FilterOnce(sections, forwards.reverse());
  return line + backwards.reverse().segment(pad, n);
}

}  // namespace warmjoint

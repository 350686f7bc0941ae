#include "identification/alternating/first_guess.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "identification/sentences/heat.h"
#include "models/friction/sign.h"

namespace warmjoint {
namespace {

constexpr int kWindows = 40;             // over the recording
constexpr double kUnsettled = 0.15;      // of the whole change, between the last two quarters
constexpr double kVisible = 4;           // standard deviations that a change must have
constexpr double kReached = 0.63212056;  // why: 1 - 1/e, where (25) reads tau

/// The samples of one window of time.
struct Window {
  double count = 0;    // kept samples
  double samples = 0;  // all samples
  double speed = 0;    // mean |v| of the kept, rad/s or m/s
  double torque = 0;   // mean sign(v) tau of the kept, N.m or N
  double level = 0;    // torque - kv speed
  double loss = 0;     // mean W of all, W
  double motion = 0;   // mean |v| of all, rad/s or m/s
};

/// Sums of the within-window spread, from which kv and the noise follow.
struct Spread {
  double speed_speed = 0;
  double speed_torque = 0;
  double torque_torque = 0;
  double count = 0;

  double viscous() const { return speed_torque / speed_speed; }
  double variance() const {
    return (torque_torque - speed_torque * speed_torque / speed_speed) / count;
  }
};

class Envelope {
 public:
  Envelope(const LogSamples& m, const Selection& selection)
      : width_((m.time[m.size() - 1] - m.time[0]) / kWindows) {
    Average(m, selection);

    // one slope over speed for all windows, from the spread within each; 0 for a single speed
    const Spread spread = SpreadWithin(m, selection);
    double mean_square = 0;
    for (const Window& window : windows_) mean_square += window.count * window.speed * window.speed;
    const bool varied = spread.speed_speed > 1e-4 * mean_square;
    const double viscous = varied ? spread.viscous() : 0;
    for (Window& window : windows_) window.level = window.torque - viscous * window.speed;

    // noise of a window's level, from the spread within windows and the samples of one
    const double variance = varied ? spread.variance() : spread.torque_torque / spread.count;
    const double per_window = spread.count / static_cast<double>(windows_.size());
    noise_ = std::sqrt(std::max(variance, 0.0) / per_window);

    size_t used = 0;
    while (used < windows_.size() && windows_[used].count > 0) ++used;
    windows_.resize(used);
  }

  /// The windows up to the first one without a kept sample, since after a long rest the joint is colder again.
  const std::vector<Window>& windows() const { return windows_; }
  double width() const { return width_; }  // s
  double noise() const { return noise_; }  // standard deviation of a window's level, N.m or N

 private:
  size_t IndexOf(const LogSamples& m, Eigen::Index i) const {
    const auto index = static_cast<size_t>((m.time[i] - m.time[0]) / width_);
    return std::min<size_t>(index, kWindows - 1);
  }

  void Average(const LogSamples& m, const Selection& selection) {
    for (Eigen::Index i = 0; i < m.size(); ++i) {
      // losses and motion of all samples, friction of those that a fit uses
      Window& window = windows_[IndexOf(m, i)];
      const double speed = std::abs(m.velocity[i]);
      window.samples += 1;
      window.loss += std::abs(m.torque[i]) * speed;
      window.motion += speed;
      if (!selection.keep[i]) continue;
      window.count += 1;
      window.speed += speed;
      window.torque += Sign(m.velocity[i]) * m.torque[i];
    }
    for (Window& window : windows_) {
      window.loss /= std::max(window.samples, 1.0);
      window.motion /= std::max(window.samples, 1.0);
      window.speed /= std::max(window.count, 1.0);
      window.torque /= std::max(window.count, 1.0);
    }
  }

  Spread SpreadWithin(const LogSamples& m, const Selection& selection) const {
    Spread spread;
    for (Eigen::Index i = 0; i < m.size(); ++i) {
      if (!selection.keep[i]) continue;
      // deviations from the window's own means
      const Window& window = windows_[IndexOf(m, i)];
      const double speed = std::abs(m.velocity[i]) - window.speed;
      const double torque = Sign(m.velocity[i]) * m.torque[i] - window.torque;
      spread.speed_speed += speed * speed;
      spread.speed_torque += speed * torque;
      spread.torque_torque += torque * torque;
      spread.count += 1;
    }
    return spread;
  }

  double width_;
  double noise_ = 0;
  std::vector<Window> windows_{kWindows};
};

/// Mean of a member over the windows [begin, end).
double Mean(const std::vector<Window>& windows, double Window::*member, size_t begin, size_t end) {
  double sum = 0;
  for (size_t i = begin; i < end; ++i) sum += windows[i].*member;
  return sum / static_cast<double>(end - begin);
}

/// Time after which the level has made 63 % of its change, s, interpolated between the centres of two windows.
double TimeTo63(const Envelope& envelope, double cold, double settled) {
  const std::vector<Window>& windows = envelope.windows();
  const auto share = [&](size_t i) { return (windows[i].level - cold) / (settled - cold); };
  size_t i = 0;
  while (i + 1 < windows.size() && share(i) < kReached) ++i;
  if (i == 0) return 0.5 * envelope.width();
  const double part = (kReached - share(i - 1)) / (share(i) - share(i - 1));
  return envelope.width() * (static_cast<double>(i) - 0.5 + part);
}

/// The envelope for plots.
TorqueEnvelope Describe(const Envelope& envelope, double cold, double settled) {
  const auto count = static_cast<Eigen::Index>(envelope.windows().size());
  TorqueEnvelope description{Eigen::VectorXd(count), Eigen::VectorXd(count), cold, settled,
                             TimeTo63(envelope, cold, settled)};
  for (Eigen::Index i = 0; i < count; ++i) {
    description.time[i] = envelope.width() * (static_cast<double>(i) + 0.5);
    description.level[i] = envelope.windows()[static_cast<size_t>(i)].level;
  }
  return description;
}

}  // namespace

FirstGuess GuessThermal(const LogSamples& measurements, const Selection& selection) {
  const Envelope envelope(measurements, selection);
  const std::vector<Window>& windows = envelope.windows();
  const size_t count = windows.size();
  if (count < 8) {
    return {{}, kRestsTooSoon};
  }

  // the level when cold, by a line through the first two windows, and once settled
  const double cold = 1.5 * windows[0].level - 0.5 * windows[1].level;
  const double settled = Mean(windows, &Window::level, count - count / 4, count);
  const double before = Mean(windows, &Window::level, count / 2, count - count / 4);
  const double change = settled - cold;
  // the change must exceed the noise and end within the log
  if (std::abs(change) < kVisible * envelope.noise()) {
    return {{}, ExplainLevelInNoise(change, envelope.noise())};
  }
  if (std::abs(settled - before) > kUnsettled * std::abs(change)) {
    return {{}, ExplainUnsettledLevel(settled - before, change)};
  }

  // (25), corrected for the feedback of E on W
  const double gain = change / Mean(windows, &Window::loss, count - count / 4, count);
  const double speed = Mean(windows, &Window::motion, count - count / 4, count);
  const TorqueEnvelope description = Describe(envelope, cold, settled);
  const double time_constant = description.time_to_63 * (1 - gain * speed);
  if (!(time_constant > 0)) {
    return {{}, kHeatsItself};
  }
  return {Thermal{gain, time_constant}, "", description};
}

}  // namespace warmjoint
